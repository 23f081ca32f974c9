#include "pseudonyms.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <optional>

#include "vicon/core/file.h"
#include "vicon/core/uid.h"

namespace vicon::ingest {
namespace {

using Seconds = std::chrono::sys_seconds;

/// Dates move by one year at least, which tells nothing of the season, and by eleven at most.
constexpr std::int64_t kSecondsADay = 86400, kLeast = 365 * kSecondsADay, kMost = 11 * kLeast;

bool isDigits(const std::string& text)
{
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

int numberAt(const std::string& digits, std::size_t from, std::size_t count)
{
    int value = 0;
    std::from_chars(digits.data() + from, digits.data() + from + count, value);
    return value;
}

/// Of "YYYYMMDD", or "YYYY.MM.DD" as DICOM's forerunner wrote it.
std::optional<Seconds> dayFrom(std::string date)
{
    std::erase(date, '.');
    if (date.size() != 8 || !isDigits(date))
        return {};
    const auto day = std::chrono::year(numberAt(date, 0, 4)) / numberAt(date, 4, 2) / numberAt(date, 6, 2);
    return day.ok() ? std::optional<Seconds>(std::chrono::sys_days(day)) : std::nullopt;
}

/// Of "HH", "HHMM" or "HHMMSS", what follows aside.
std::optional<std::chrono::seconds> timeFrom(std::string time)
{
    std::erase(time, ':');
    if (!isDigits(time) || time.size() % 2 != 0 || time.size() > 6)
        return {};
    time.append(6 - time.size(), '0');
    return std::chrono::hours(numberAt(time, 0, 2)) + std::chrono::minutes(numberAt(time, 2, 2)) +
           std::chrono::seconds(numberAt(time, 4, 2));
}

std::string dateOf(Seconds moment)
{
    const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(moment));
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%04d%02u%02u", int(day.year()), unsigned(day.month()),
                  unsigned(day.day()));
    return text.data();
}

std::string timeOf(Seconds moment)
{
    const std::chrono::hh_mm_ss time(moment - std::chrono::floor<std::chrono::days>(moment));
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%02d%02d%02d", int(time.hours().count()), int(time.minutes().count()),
                  int(time.seconds().count()));
    return text.data();
}

/// The part of a second, with its point; empty where there is none.
std::string fractionOf(const std::string& time)
{
    const auto point = time.find('.');
    return point != std::string::npos && isDigits(time.substr(point + 1)) ? time.substr(point) : "";
}

}  // namespace

Pseudonyms::Pseudonyms(std::string key, const std::string& patient) : key_(std::move(key))
{
    constexpr std::size_t kDigits = 10, kDigitsOfSpan = 12;
    const std::string digest = sha256(key_ + "\npatient\n" + patient);
    patient_ = "anon-" + digest.substr(0, kDigits);
    const std::int64_t any = std::stoll(digest.substr(kDigits, kDigitsOfSpan), nullptr, 16);
    earlier_s_ = kLeast + any % (kMost - kLeast);
}

std::string Pseudonyms::uid(const std::string& original) const
{
    if (original.empty() || original.starts_with("1.2.840.10008."))
        return original;
    return uidFor(key_ + "\nuid\n" + original);
}

Pseudonyms::Moment Pseudonyms::earlier(const std::string& date, const std::string& time) const
{
    const auto day = dayFrom(date);
    if (!day)
        return {};
    const auto of_day = timeFrom(time.substr(0, time.find('.')));
    const Seconds moment = *day + of_day.value_or(std::chrono::seconds(0)) - std::chrono::seconds(earlier_s_);
    return {dateOf(moment), of_day ? timeOf(moment) + fractionOf(time) : ""};
}

std::string Pseudonyms::earlier(const std::string& date_time) const
{
    constexpr std::size_t kDay = 8;
    const std::string local = date_time.substr(0, date_time.find_first_of("+-"));
    if (local.size() < kDay)
        return {};
    const Moment moment = earlier(local.substr(0, kDay), local.substr(kDay));
    return moment.date + moment.time;
}

}  // namespace vicon::ingest

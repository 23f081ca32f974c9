#include "vicon/cases/growth.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "json_fields.h"
#include "vicon/core/enum_names.h"

using nlohmann::json;

namespace vicon {
namespace {

/// A third of the smallest polyp that is reported; thicker slices do not show its height.
constexpr double kMostSlice_mm = 2;
/// A blur of 0.7 in place of 0.5 mm changes 8 mm by 5 %.
constexpr double kMostSliceDifference_mm = 0.3;
/// Of one reader's diameters by hand: the worst published standard deviation (23 objects, PMID 18430844).
constexpr double kByHand_mm = 1.76;
/// Of automatic volumes (9 objects, PMID 21611052).
constexpr double kVolumeError = 0.09;
constexpr double kEightInTen = 1.2816;  // of a normal distribution, in standard deviations each way
constexpr double kStable_percent_a_year = 20;
constexpr double kLeastYears = 0.25;  // a rate of less is a guess
constexpr double kDaysOfYear = 365.25;

std::string printedNumbers(const char* pattern, double a, double b = 0, double c = 0)
{
    std::array<char, 160> out{};
    std::snprintf(out.data(), out.size(), pattern, a, b, c);
    return out.data();
}

std::optional<std::chrono::sys_days> dayOf(const std::string& date)
{
    constexpr std::size_t kDigits = 8;
    int number = 0;
    const auto [end, problem] = std::from_chars(date.data(), date.data() + date.size(), number);
    if (date.size() != kDigits || problem != std::errc() || end != date.data() + date.size())
        return std::nullopt;
    const std::chrono::year_month_day day{std::chrono::year(number / 10000),
                                          std::chrono::month(unsigned(number / 100 % 100)),
                                          std::chrono::day(unsigned(number % 100))};
    return day.ok() ? std::optional(std::chrono::sys_days(day)) : std::nullopt;
}

std::optional<double> yearsBetween(const std::string& before, const std::string& now)
{
    const auto from = dayOf(before), to = dayOf(now);
    return from && to ? std::optional(double((*to - *from).count()) / kDaysOfYear) : std::nullopt;
}

/// Why the two cannot be compared; empty where they can.
std::string whyNot(const MeasuredSize& before, const MeasuredSize& now)
{
    if (!before.size_mm)
        return "the earlier report gives no size";
    if (!now.size_mm)
        return "no size was measured now";
    if (before.from != now.from)
        return "the sizes were taken in different ways (then: " +
               (before.from.empty() ? std::string("not said") : before.from) + ", now: " + now.from + ")";
    if (before.least_mm.has_value() != now.least_mm.has_value())
        return "one size was outlined, the other measured by hand";
    for (const auto& [size, when] : {std::pair{&before, "then"}, {&now, "now"}}) {
        if (size->slice_thickness_mm <= 0)
            return std::string("the slice thickness ") + when + " is not known";
        if (size->kernel.empty())
            return std::string("the kernel ") + when + " is not known";
        if (size->slice_thickness_mm > kMostSlice_mm)
            return printedNumbers("slices of %.1f mm are too thick to compare sizes by", size->slice_thickness_mm);
    }
    if (before.kernel != now.kernel)
        return "the kernels differ (then: " + before.kernel + ", now: " + now.kernel + ")";
    if (std::abs(before.slice_thickness_mm - now.slice_thickness_mm) > kMostSliceDifference_mm)
        return printedNumbers("the slices differ (then: %.1f mm, now: %.1f mm)", before.slice_thickness_mm,
                              now.slice_thickness_mm);
    return {};
}

/// Between what a diameter lies, each way.
double halfOf(const MeasuredSize& size)
{
    return size.least_mm && size.most_mm ? (*size.most_mm - *size.least_mm) / 2 : kEightInTen * kByHand_mm;
}

/// Of a volume, as a part of it: its own, else what its diameter's uncertainty makes of it; at least the published one.
double volumeErrorOf(const MeasuredSize& size)
{
    constexpr int kDimensions = 3;
    const bool own = size.volume_least_ml && size.volume_most_ml && *size.volume_ml > 0;
    const double part = own ? (*size.volume_most_ml - *size.volume_least_ml) / 2 / *size.volume_ml
                            : kDimensions * halfOf(size) / *size.size_mm;
    return std::max(kEightInTen * kVolumeError, part);
}

Change around(double about, double half)
{
    return {about, about - half, about + half};
}

void addVolume(Growth& growth, const MeasuredSize& before, const MeasuredSize& now)
{
    if (!before.volume_ml || !now.volume_ml || *before.volume_ml <= 0)
        return;
    const double ratio = *now.volume_ml / *before.volume_ml;
    const double half = ratio * std::hypot(volumeErrorOf(before), volumeErrorOf(now));
    Change percent = around(100 * (ratio - 1), 100 * half);
    percent.least = std::max(percent.least, -100.0);
    growth.volume_percent = percent;
    if (!growth.years || *growth.years < kLeastYears)
        return;
    const double years = *growth.years;
    const Change yearly{percent.about / years, percent.least / years, percent.most / years};
    growth.percent_a_year = yearly;
    growth.verdict = std::abs(yearly.about) < kStable_percent_a_year ? GrowthVerdict::stable
                     : yearly.least > 0                              ? GrowthVerdict::grew
                     : yearly.most < 0                               ? GrowthVerdict::shrank
                                                                     : GrowthVerdict::not_sure;
}

constexpr EnumNames<GrowthVerdict, 4> kVerdictNames{{{GrowthVerdict::grew, "grew"},
                                                     {GrowthVerdict::stable, "stable"},
                                                     {GrowthVerdict::shrank, "shrank"},
                                                     {GrowthVerdict::not_sure, "not sure"}}};

json changeJson(const Change& change)
{
    return {{"about", change.about}, {"least", change.least}, {"most", change.most}};
}

}  // namespace

std::string nameOf(GrowthVerdict verdict)
{
    return nameIn(kVerdictNames, verdict);
}

json toJson(const MeasuredSize& s)
{
    json out = {{"from", s.from}, {"kernel", s.kernel}, {"slice_thickness_mm", s.slice_thickness_mm}, {"date", s.date}};
    putValue(out, "size_mm", s.size_mm);
    putValue(out, "least_mm", s.least_mm);
    putValue(out, "most_mm", s.most_mm);
    putValue(out, "volume_ml", s.volume_ml);
    putValue(out, "volume_least_ml", s.volume_least_ml);
    putValue(out, "volume_most_ml", s.volume_most_ml);
    return out;
}

MeasuredSize measuredSizeFromJson(const json& from)
{
    return {number(from, "size_mm"),        from.value("from", ""),    number(from, "least_mm"),
            number(from, "most_mm"),        number(from, "volume_ml"), number(from, "volume_least_ml"),
            number(from, "volume_most_ml"), from.value("kernel", ""),  from.value("slice_thickness_mm", 0.0),
            from.value("date", "")};
}

json toJson(const Growth& g)
{
    json out = {{"verdict", g.verdict ? nameOf(*g.verdict) : ""}, {"why_not", g.why_not}};
    putValue(out, "years", g.years);
    for (const auto& [key, change] : {std::pair{"diameter_mm", &g.diameter_mm},
                                      {"volume_percent", &g.volume_percent},
                                      {"percent_a_year", &g.percent_a_year}})
        if (*change)
            out[key] = changeJson(**change);
    return out;
}

Growth growthFromJson(const json& from)
{
    Growth growth{.years = number(from, "years"), .why_not = from.at("why_not").get<std::string>()};
    if (const auto verdict = from.at("verdict").get<std::string>(); !verdict.empty())
        growth.verdict = valueIn(kVerdictNames, verdict, "growth");
    for (const auto& [key, change] : {std::pair{"diameter_mm", &growth.diameter_mm},
                                      {"volume_percent", &growth.volume_percent},
                                      {"percent_a_year", &growth.percent_a_year}})
        if (from.contains(key))
            *change = Change{from[key].at("about").get<double>(), from[key].at("least").get<double>(),
                             from[key].at("most").get<double>()};
    return growth;
}

Growth growthBetween(const MeasuredSize& before, const MeasuredSize& now)
{
    Growth growth;
    growth.years = yearsBetween(before.date, now.date);
    growth.why_not =
        growth.years && *growth.years < 0 ? "the earlier report is dated after this examination" : whyNot(before, now);
    if (!growth.why_not.empty())
        return growth;
    growth.diameter_mm = around(*now.size_mm - *before.size_mm, std::hypot(halfOf(before), halfOf(now)));
    addVolume(growth, before, now);
    return growth;
}

std::string growthWords(const Growth& g)
{
    if (!g.why_not.empty())
        return "growth is not told: " + g.why_not;
    std::string out =
        printedNumbers("%+.1f mm (%+.1f to %+.1f)", g.diameter_mm->about, g.diameter_mm->least, g.diameter_mm->most);
    if (const auto& v = g.volume_percent)
        out += printedNumbers(", volume %+.0f %% (%+.0f to %+.0f)", v->about, v->least, v->most);
    if (const auto& y = g.percent_a_year)
        out += printedNumbers(", %+.0f %% a year (%+.0f to %+.0f)", y->about, y->least, y->most);
    if (g.years)
        out += printedNumbers(" in %.1f years", *g.years);
    if (g.verdict)
        out += ": " + nameOf(*g.verdict);
    return out;
}

}  // namespace vicon

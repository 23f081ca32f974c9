#include "vicon/report/wording.h"

#include <unicode/uchar.h>
#include <unicode/uscript.h>
#include <unicode/utf8.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <vector>

#include "vicon/cases/records.h"

namespace vicon::report {
namespace {

/// Factors from the distance along a CT skeleton to that along a colonoscope, as published: the endoscope pleats the
/// bowel. They are averages over patients, not chosen on any case here.
constexpr double kCaecumFactor = 0.57, kRightColonFactor = 0.59, kLeftColonFactor = 0.78;

std::vector<std::string> split(std::string_view text, char separator)
{
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string joined(const std::vector<std::string>& parts, const char* separator)
{
    std::string out;
    for (const std::string& part : parts)
        if (!part.empty())
            out += (out.empty() ? "" : separator) + part;
    return out;
}

/// Whether a letter of one of these scripts is in the text.
bool hasScript(std::string_view text, std::initializer_list<UScriptCode> scripts)
{
    for (std::int32_t at = 0, size = std::int32_t(text.size()); at < size;) {
        UChar32 c = 0;
        U8_NEXT(text.data(), at, size, c);
        UErrorCode status = U_ZERO_ERROR;
        const UScriptCode script = c < 0 ? USCRIPT_COMMON : uscript_getScript(c, &status);
        if (std::find(scripts.begin(), scripts.end(), script) != scripts.end())
            return true;
    }
    return false;
}

/// One group of a person name: alphabetic, ideographic or phonetic.
std::string nameGroup(const std::string& group)
{
    std::vector<std::string> part = split(group, '^');
    part.resize(5);
    for (std::string& p : part)
        p = trimmed(p);
    const std::string given = joined({part[3], part[1], part[2]}, " ");
    const bool east_asian = hasScript(group, {USCRIPT_HAN, USCRIPT_HIRAGANA, USCRIPT_KATAKANA, USCRIPT_HANGUL});
    const char* comma = east_asian ? " " : hasScript(group, {USCRIPT_ARABIC}) ? "\u060c " : ", ";
    return joined({part[0], given, part[4]}, comma);
}

bool isNumber(std::string_view text)
{
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string format(const char* pattern, double value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), pattern, value);
    return text.data();
}

/// The number as printed, and whether it is printed as zero: then its sign says nothing.
std::string oneDecimal(double value)
{
    return format("%.1f", std::abs(value));
}

bool isNegative(double value)
{
    return value < 0 && oneDecimal(value) != "0.0";
}

std::string wholeCentimetres(double length_mm)
{
    return format("%.0f", length_mm / 10);
}

}  // namespace

std::string personName(std::string_view dicom_name)
{
    std::vector<std::string> groups;
    for (const std::string& group : split(dicom_name, '='))
        if (std::string words = nameGroup(group); !words.empty())
            groups.push_back(std::move(words));
    if (groups.empty())
        return {};
    const std::string first = groups.front();
    groups.erase(groups.begin());
    return groups.empty() ? first : first + " (" + joined(groups, ", ") + ")";
}

std::string dateWords(std::string_view dicom_date)
{
    static constexpr std::array<const char*, 12> kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                            "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    std::string text(dicom_date);
    if (text.size() != 8 || !isNumber(text))
        return text;
    const int month = std::stoi(text.substr(4, 2)), day = std::stoi(text.substr(6, 2));
    if (month < 1 || month > 12 || day < 1 || day > 31)
        return text;
    return std::to_string(day) + " " + kMonths[std::size_t(month - 1)] + " " + text.substr(0, 4);
}

std::string dateTimeWords(std::string_view dicom_date, std::string_view dicom_time)
{
    std::string out = dateWords(dicom_date);
    if (dicom_time.size() >= 4 && isNumber(dicom_time.substr(0, 4)))
        out += (out.empty() ? "" : ", ") + std::string(dicom_time.substr(0, 2)) + ":" +
               std::string(dicom_time.substr(2, 2));
    return out;
}

std::string utcWords(std::string_view utc)
{
    if (utc.size() != 20 || utc[4] != '-' || utc[7] != '-' || utc[10] != 'T' || utc[19] != 'Z')
        return std::string(utc);
    const std::string date =
        std::string(utc.substr(0, 4)) + std::string(utc.substr(5, 2)) + std::string(utc.substr(8, 2));
    return dateWords(date) + " " + std::string(utc.substr(11, 5)) + " UTC";
}

std::string sexWords(std::string_view dicom_sex)
{
    return dicom_sex == "M"   ? "male"
           : dicom_sex == "F" ? "female"
           : dicom_sex == "O" ? "other"
                              : std::string(dicom_sex);
}

std::string patientPositionWords(const std::string& patient_position)
{
    if (patient_position.empty())
        return "position not given";
    std::string words = positionName(patient_position);
    if (words == "unknown")
        return patient_position;
    if (patient_position.starts_with("HF"))
        words += ", head first";
    if (patient_position.starts_with("FF"))
        words += ", feet first";
    return words;
}

std::string positionLetters(Point3 p)
{
    return (isNegative(p.x) ? "R " : "L ") + oneDecimal(p.x) + (isNegative(p.y) ? ", A " : ", P ") + oneDecimal(p.y) +
           (isNegative(p.z) ? ", F " : ", H ") + oneDecimal(p.z) + " mm";
}

std::string positionWords(Point3 p)
{
    return std::string(isNegative(p.x) ? "right, " : "left, ") + (isNegative(p.y) ? "anterior, " : "posterior, ") +
           (isNegative(p.z) ? "footward" : "headward") + " of the scan's origin";
}

std::string millimetres(double length_mm, int decimals)
{
    return format(decimals == 0 ? "%.0f mm" : "%.1f mm", length_mm + 0.0);
}

std::string percent(double fraction, int decimals)
{
    return format(decimals == 0 ? "%.0f %%" : "%.1f %%", 100 * fraction);
}

std::string endoscopeEstimate(double station_mm, std::string_view part_name)
{
    const auto single = [&](double factor, const char* where) {
        return "about " + wholeCentimetres(station_mm * factor) + " cm (" + format("%.2f", factor) +
               " \u00d7 CT distance, " + where + ")";
    };
    if (part_name == "caecum")
        return single(kCaecumFactor, "caecum");
    if (part_name == "ascending" || part_name == "hepatic flexure")
        return single(kRightColonFactor, "right colon");
    if (part_name == "rectum" || part_name == "sigmoid" || part_name == "descending" || part_name == "splenic flexure")
        return single(kLeftColonFactor, "left colon");
    const std::string low = wholeCentimetres(station_mm * kRightColonFactor);
    const std::string high = wholeCentimetres(station_mm * kLeftColonFactor);
    return "about " + (low == high ? low : low + " to " + high) + " cm (" + format("%.2f", kRightColonFactor) + " to " +
           format("%.2f", kLeftColonFactor) + " \u00d7 CT distance)";
}

std::string distancesExplained()
{
    return "Distances are measured along the skeleton of the colon in the CT scan. An endoscope pleats the bowel and "
           "shows "
           "shorter ones: its distance is estimated with the published factors of the caecum (" +
           format("%.2f", kCaecumFactor) + "), the right colon (" + format("%.2f", kRightColonFactor) +
           ") and the left colon (" + format("%.2f", kLeftColonFactor) + ").";
}

}  // namespace vicon::report

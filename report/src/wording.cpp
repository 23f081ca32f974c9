#include "vicon/report/wording.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "vicon/cases/finding_facts.h"
#include "vicon/cases/printed.h"
#include "vicon/cases/records.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/error.h"

namespace vicon::report {
namespace {

/// Nothing where the part is not known.
std::optional<ColonPart> partNamed(std::string_view name)
{
    try {
        return colonPartFrom(std::string(name));
    } catch (const Error&) {
        return std::nullopt;
    }
}

const char* sideOf(ColonPart part)
{
    switch (part) {
        case ColonPart::caecum:
            return "caecum";
        case ColonPart::ascending:
        case ColonPart::hepatic_flexure:
            return "right colon";
        default:
            return "left colon";
    }
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

std::string dateTimeWords(std::string_view dicom_date, std::string_view dicom_time)
{
    std::string out = printedDate(dicom_date);
    if (dicom_time.size() >= 4 && isNumber(dicom_time.substr(0, 4)))
        out += (out.empty() ? "" : ", ") + std::string(dicom_time.substr(0, 2)) + ":" +
               std::string(dicom_time.substr(2, 2));
    return out;
}

std::string utcWords(std::string_view utc)
{
    if (utc.size() != 20 || utc[4] != '-' || utc[7] != '-' || utc[10] != 'T' || utc[19] != 'Z')
        return std::string(utc);
    return std::string(utc.substr(0, 10)) + " " + std::string(utc.substr(11, 5)) + " UTC";
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
    const BodyPosition position = bodyPositionFrom(patient_position);
    if (position == BodyPosition::unknown)
        return patient_position;
    std::string words = nameOf(position);
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
    const auto part = partNamed(part_name);
    const auto [least, most] = endoscopeFactors(part);
    if (least == most)
        return "about " + wholeCentimetres(station_mm * least) + " cm (" + format("%.2f", least) +
               " \u00d7 CT distance, " + sideOf(*part) + ")";
    const std::string low = wholeCentimetres(station_mm * least), high = wholeCentimetres(station_mm * most);
    return "about " + (low == high ? low : low + " to " + high) + " cm (" + format("%.2f", least) + " to " +
           format("%.2f", most) + " \u00d7 CT distance)";
}

std::string distancesExplained()
{
    const auto factor = [](ColonPart part) { return format("%.2f", endoscopeFactors(part).first); };
    return "Distances are measured along the centreline of the colon in the CT scan. An endoscope pleats the bowel and "
           "shows shorter ones: its distance is estimated with the published factors of the caecum (" +
           factor(ColonPart::caecum) + "), the right colon (" + factor(ColonPart::ascending) +
           ") and the left colon (" + factor(ColonPart::sigmoid) + ").";
}

}  // namespace vicon::report

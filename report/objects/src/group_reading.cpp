#include "group_reading.h"

#include <algorithm>
#include <map>

#include "code_reading.h"
#include "vicon/core/printable.h"

namespace vicon::report {

std::optional<double> inMillimetres(const ContentItem& item)
{
    if (!item.number || *item.number < 0)
        return std::nullopt;
    if (item.code.value == "mm")
        return item.number;
    if (item.code.value == "cm")
        return *item.number * 10;
    return std::nullopt;
}

namespace {

std::optional<double> inMillilitres(const ContentItem& item)
{
    constexpr double kMicrolitres = 1000;
    if (!item.number || *item.number < 0)
        return std::nullopt;
    if (item.code.value == "ml" || item.code.value == "mL" || item.code.value == "cm3")
        return item.number;
    if (item.code.value == "mm3" || item.code.value == "ul")
        return *item.number / kMicrolitres;
    return std::nullopt;
}

/// A number of a finding that the code names, and where it goes.
struct Place {
    const char* value;  ///< of the code
    std::optional<double> (*read)(const ContentItem&);
    std::optional<double> PriorSight::*of_sight;
    std::optional<double> PriorFinding::*of_finding;
};

std::optional<double> asItStands(const ContentItem& item)
{
    return item.number;
}

std::optional<double> asFraction(const ContentItem& item)
{
    return item.number && *item.number >= 0 && *item.number <= 1 ? item.number : std::nullopt;
}

/// Ours, and those of TID 1500 and CID 7469, also by the older codes of SNOMED.
constexpr Place kPlaces[] = {
    {"373197004", inMillimetres, nullptr, &PriorFinding::size_mm},
    {"HEIGHT", inMillimetres, nullptr, &PriorFinding::height_mm},
    {"118565006", inMillilitres, nullptr, &PriorFinding::volume_ml},
    {"G-D705", inMillilitres, nullptr, &PriorFinding::volume_ml},
    {"112233", inMillimetres, &PriorSight::station_mm, nullptr},
    {"FROM_CAECUM", inMillimetres, &PriorSight::from_caecum_mm, nullptr},
    {"FRACTION", asFraction, &PriorSight::fraction, nullptr},
    {"PART_FRACTION", asFraction, &PriorSight::part_fraction, nullptr},
    {"SIZE_2D", inMillimetres, &PriorSight::size_2d_mm, nullptr},
    {"SIZE_IN_SLICE", inMillimetres, &PriorSight::size_2d_mm, nullptr},
    {"SIZE_3D", inMillimetres, &PriorSight::size_3d_mm, nullptr},
    {"OUTLINE_LEAST", inMillimetres, &PriorSight::size_least_mm, nullptr},
    {"OUTLINE_MOST", inMillimetres, &PriorSight::size_most_mm, nullptr},
    {"OUTLINE_HEIGHT", inMillimetres, &PriorSight::height_mm, nullptr},
    {"OUTLINE_VOLUME", inMillilitres, &PriorSight::volume_ml, nullptr},
    {"OUTLINE_VOLUME_LEAST", inMillilitres, &PriorSight::volume_least_ml, nullptr},
    {"OUTLINE_VOLUME_MOST", inMillilitres, &PriorSight::volume_most_ml, nullptr},
    {"112031007", asItStands, &PriorSight::mean_hu, nullptr},
};
/// Of a finding whose largest dimension is not given: what other makers measure, the best first.
constexpr const char* kDiameters[] = {"103339001", "G-A185", "81827009", "M-02550", "410668003", "G-D7FE"};

class GroupReader {
public:
    GroupReader(PriorFinding& finding, PriorSight& sight, const ContentDocument& document)
        : finding_(finding), sight_(sight), document_(document)
    {
    }
    void read(const ContentItem& group)
    {
        for (const ContentItem& item : group.children)
            readItem(item);
        for (const char* code : kDiameters)
            if (const auto found = diameters_.find(code); found != diameters_.end() && !finding_.size_mm) {
                finding_.size_mm = found->second.first;
                finding_.size_from = found->second.second;
            }
    }

private:
    void readItem(const ContentItem& item)
    {
        if (item.name.value == "COMPARISON")
            return;  // what it was in a report still earlier
        if (item.type == "NUM")
            readNumber(item);
        else if (item.type == "CODE")
            readCode(item);
        else if (item.type == "TEXT")
            readText(item);
        else if (item.type == "SCOORD3D" && item.graphic == "POINT" && item.points_mm.size() == 1) {
            sight_.position_mm = item.points_mm.front();
            sight_.frame_of_reference_uid = item.frame_of_reference_uid;
        } else if (item.type == "SCOORD3D" && !item.points_mm.empty() && !sight_.position_mm) {
            sight_.position_mm = middleOf(item.points_mm);
            sight_.frame_of_reference_uid = item.frame_of_reference_uid;
        } else if (item.type == "IMAGE" && sight_.image_uid.empty())
            takeImage(item.reference.sop_uid);
        if (item.type == "NUM" || item.type == "CONTAINER" || item.type == "SCOORD3D")
            for (const ContentItem& below : item.children)  // where and on which image it was measured
                readItem(below);
    }

    static Point3 middleOf(const std::vector<Point3>& points)
    {
        Vector3 sum{};
        for (const Point3& p : points)
            sum += p - points.front();
        return points.front() + sum * (1.0 / double(points.size()));
    }

    void takeImage(const std::string& uid)
    {
        sight_.image_uid = uid;
        if (const auto found = document_.evidence.find(uid); found != document_.evidence.end())
            sight_.series_uid = found->second;
    }

    void readNumber(const ContentItem& item)
    {
        if (!item.number)
            return;
        for (const Place& place : kPlaces) {
            if (item.name.value != place.value)
                continue;
            if (const auto value = place.read(item)) {
                (place.of_sight ? sight_.*place.of_sight : finding_.*place.of_finding) = value;
                return;
            }
        }
        for (const auto& [code, distance] : {std::pair{"ENDOSCOPE_ABOUT", &EndoscopeDistance::about_mm},
                                             {"ENDOSCOPE_LEAST", &EndoscopeDistance::least_mm},
                                             {"ENDOSCOPE_MOST", &EndoscopeDistance::most_mm}})
            if (const auto value = inMillimetres(item); value && item.name.value == code) {
                if (!finding_.endoscope)
                    finding_.endoscope.emplace();
                *finding_.endoscope.*distance = *value;
                return;
            }
        if (const auto value = inMillimetres(item);
            value && std::count(std::begin(kDiameters), std::end(kDiameters), item.name.value))
            diameters_.try_emplace(item.name.value, *value, item.name.meaning);
        finding_.others.push_back({item.name.meaning, *item.number, item.code.value});
    }

    void readCode(const ContentItem& item)
    {
        if (item.name.value == "121071") {
            finding_.kind = findingKindOf(item.code);
            finding_.what = item.code.meaning;
        } else if (isSite(item.name)) {
            sight_.part = colonPartOf(item.code);
            sight_.site = item.code.meaning;
        } else if (item.name.value == "SIZE_FROM")
            finding_.size_from = item.code.meaning;
        else if (item.name.value == "EXTENT") {
            finding_.narrows_lumen |= item.code.value == "NARROWS_LUMEN";
            finding_.invades |= item.code.value == "INVADES";
        } else if (const auto morphology = morphologyOf(item.code); morphology && item.name.value == "MORPHOLOGY")
            finding_.morphology = morphology;
        else if (const auto attenuation = attenuationOf(item.code); attenuation && item.name.value == "ATTENUATION")
            finding_.attenuation = attenuation;
        else if (const auto confidence = confidenceOf(item.code); confidence && item.name.value == "CONFIDENCE")
            finding_.confidence = confidence;
    }

    /// What a table shows in a cell.
    static std::string lineOf(const std::string& text)
    {
        constexpr int kLongest = 64;
        return shortened(printable(text), kLongest);
    }

    void readText(const ContentItem& item)
    {
        if (item.name.value == "112039")
            finding_.name = lineOf(item.text);
        else if (item.name.value == "121106")
            finding_.note = item.text;
        else if (item.name.value == "MARKER")
            sight_.marker = lineOf(item.text);
        else if (item.name.value == "CLOCK_FACE")
            sight_.clock_hour = hourFrom(item.text);
    }

    PriorFinding& finding_;
    PriorSight& sight_;
    const ContentDocument& document_;
    std::map<std::string, std::pair<double, std::string>> diameters_;
};

}  // namespace

void readGroup(const ContentItem& group, const ContentDocument& document, PriorFinding& finding, PriorSight& sight)
{
    GroupReader(finding, sight, document).read(group);
}

}  // namespace vicon::report

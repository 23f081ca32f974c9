#include "vicon/report/statements.h"

#include <array>
#include <cstdio>

#include "describe_json.h"
#include "quality_words.h"
#include "vicon/cases/printed.h"
#include "vicon/report/wording.h"

using nlohmann::json;

namespace vicon::report {
namespace {

constexpr const char* kNotGiven = "not given";

void addGiven(std::vector<Statement>& out, const char* label, const std::string& text)
{
    if (!text.empty())
        out.push_back({label, text});
}

std::string orNotGiven(const std::string& text)
{
    return text.empty() ? kNotGiven : text;
}

std::string seriesWords(const Series& series)
{
    std::string out = std::to_string(series.number);
    if (!series.description.empty())
        out += ", " + series.description;
    if (!series.kernel.empty())
        out += ", kernel " + series.kernel;
    if (!series.manufacturer.empty())
        out += ", " + series.manufacturer;
    return out;
}

std::string number(double value, const char* pattern)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), pattern, value);
    return text.data();
}

std::string geometryWords(const json& geometry)
{
    if (!geometry.is_object())
        return {};
    std::string out;
    if (const auto slices = geometry.find("slices"); slices != geometry.end() && slices->is_number())
        out = std::to_string(slices->get<int>()) + " slices";
    if (geometry.contains("columns") && geometry.contains("rows"))
        out += " of " + geometry["columns"].dump() + " \u00d7 " + geometry["rows"].dump();
    if (const auto spacing = geometry.find("spacing_mm");
        spacing != geometry.end() && spacing->is_array() && spacing->size() == 3) {
        out += out.empty() ? "voxels of " : ", voxels of ";
        for (std::size_t axis = 0; axis < 3; ++axis)
            out += (axis ? " \u00d7 " : "") + number((*spacing)[axis].get<double>(), "%.2f");
        out += " mm";
    }
    if (const double tilt_deg = numberAt(geometry, "tilt_deg"); tilt_deg != 0)
        out += ", gantry tilt of " + number(tilt_deg, "%.1f") + "\u00b0 removed";
    return out;
}

std::string resultWords(const ScanEntry& entry)
{
    if (!entry.verdict)
        return "not prepared";
    std::string out = verdictText(*entry.verdict, entry.organ_title) + ", confidence " + percent(entry.confidence, 0);
    if (!entry.reason.empty())
        out += ": " + entry.reason;
    return out;
}

std::string bridgeWords(const std::vector<ReviewedBridge>& bridges)
{
    if (bridges.empty())
        return "none";
    std::string out;
    for (const auto& [bridge, review] : bridges) {
        out.append(out.empty() ? "" : "\n").append(millimetres(bridge.length_mm));
        out += ", confidence " + percent(bridge.confidence, 0) + (bridge.certain ? "" : " (low)");
        if (!bridge.reason.empty())
            out += ": " + bridge.reason;
        if (review)
            out += "; " + nameOf(review->verdict) + " by " + review->by + ", " + review->at;
    }
    return std::to_string(bridges.size()) + (bridges.size() == 1 ? " collapsed segment: " : " collapsed segments:\n") +
           out;
}

std::string densityWords(const DensitySample& sample)
{
    std::string words = number(sample.mean_hu, "%.0f") + " \u00b1 " + number(sample.sd_hu, "%.0f") + " HU, of " +
                        std::to_string(sample.voxels) + " voxels within " + millimetres(sample.radius_mm, 1);
    constexpr double kWorthSaying = 0.2;
    if (sample.fat_fraction >= kWorthSaying)
        words += "; " + percent(sample.fat_fraction, 0) + " of them of fat attenuation";
    return words;
}

/// What the reader measured.
std::string sizeWords(const MarkerSize& size)
{
    const std::string in_plane =
        size.plane ? ", " + millimetres(size.plane->diameter_mm, 1) + " largest in the best plane" : "";
    if (const auto& polyp = size.polyp) {
        const char* pattern = volumeDecimals(polyp->volume_ml) == 2 ? "%.2f" : "%.3f";
        std::string words = millimetres(polyp->diameter_mm, 1) + " outlined (" + number(polyp->least_mm, "%.1f") +
                            " to " + millimetres(polyp->most_mm, 1) + ")" + in_plane + ", height " +
                            millimetres(polyp->height_mm, 1) + ", volume " + number(polyp->volume_ml, pattern) + " ml";
        if (polyp->volume_least_ml && polyp->volume_most_ml)
            words += " (" + number(*polyp->volume_least_ml, pattern) + " to " +
                     number(*polyp->volume_most_ml, pattern) + " ml)";
        return words;
    }
    std::string words = millimetres(size.straight_mm, 1) + (size.in_slice ? " in a slice" : " straight");
    if (size.along_mm)
        words += ", " + millimetres(*size.along_mm, 1) + " along the wall";
    return words + in_plane;
}

}  // namespace

std::vector<Statement> patientStatements(const CaseRecord& a_case)
{
    const Patient& patient = a_case.patient;
    return {{"Name", orNotGiven(printedName(patient.name))},
            {"Patient ID", orNotGiven(patient.id)},
            {"Birth date", orNotGiven(printedDate(patient.birth_date))},
            {"Sex", orNotGiven(sexWords(patient.sex))}};
}

std::vector<Statement> studyStatements(const CaseRecord& a_case)
{
    const Study& study = a_case.study;
    std::vector<Statement> out{{"Study date", orNotGiven(dateTimeWords(study.date, study.time))}};
    addGiven(out, "Description", study.description);
    addGiven(out, "Accession", study.accession_number);
    addGiven(out, "Study ID", study.id);
    addGiven(out, "Referred by", printedName(study.referring_physician));
    addGiven(out, "Institution", study.institution);
    return out;
}

std::string scanTitle(const ScanEntry& entry)
{
    std::string words = patientPositionWords(entry.scan.series.patient_position);
    if (!words.empty() && words[0] >= 'a' && words[0] <= 'z')
        words[0] = char(words[0] - 'a' + 'A');
    return words + " \u00b7 series " + std::to_string(entry.scan.series.number);
}

std::vector<Statement> scanStatements(const ScanEntry& entry)
{
    std::vector<Statement> out{{"Series", seriesWords(entry.scan.series)}};
    const json& ingest = entry.scan.ingest;
    if (ingest.is_object() && ingest.contains("geometry"))
        addGiven(out, "Geometry", geometryWords(ingest["geometry"]));
    if (entry.scan.series.lossy)
        out.push_back({"Compression", "LOSSY: the images lost detail before VICON received them"});
    out.push_back({"Verdict", resultWords(entry)});
    if (entry.skeleton_length_mm > 0) {
        out.push_back({"Colon length", millimetres(entry.skeleton_length_mm) + " along the centreline"});
        out.push_back({"Collapsed", bridgeWords(entry.bridges)});
    }
    addGiven(out, "Lumen given", entry.lumen_given);
    if (entry.quality)
        out.push_back({"Quality", qualityWords(*entry.quality)});
    if (ingest.is_object()) {
        addGiven(out, "Repaired", joinedLines(describeNotes(ingest.value("repairs", json::array()))));
        addGiven(out, "Refused", joinedLines(describeNotes(ingest.value("refused", json::array()))));
    }
    return out;
}

bool isPlain(const ScanEntry& entry)
{
    constexpr double kSure = 0.9;  // as the segmentation calls a colon that it does not doubt
    const json& ingest = entry.scan.ingest;
    const auto empty = [&](const char* list) {
        return !ingest.is_object() || describeNotes(ingest.value(list, json::array())).empty();
    };
    return entry.verdict == Verdict::found && entry.lumen_given.empty() && entry.confidence >= kSure &&
           entry.skeleton_length_mm > 0 && entry.bridges.empty() && !entry.scan.series.lossy && entry.quality &&
           entry.quality->whole.adequate && entry.quality->reason.empty() && empty("repairs") && empty("refused");
}

Statement briefStatement(const ScanEntry& entry)
{
    const json& ingest = entry.scan.ingest;
    std::string text = seriesWords(entry.scan.series);
    if (ingest.is_object() && ingest.contains("geometry"))
        text += "; " + geometryWords(ingest["geometry"]);
    text += "; colon of " + millimetres(entry.skeleton_length_mm);
    if (entry.quality && entry.quality->noise_hu > 0)
        text += "; noise " + number(entry.quality->noise_hu, "%.0f HU");
    return {scanTitle(entry), text};
}

std::vector<Statement> markerStatements(const MarkerEntry& entry)
{
    const Marker& marker = entry.marker;
    const double length_mm = marker.station_mm + marker.from_caecum_mm;
    std::vector<Statement> out;
    out.push_back({"Position", positionLetters(marker.position_mm) + " (" + positionWords(marker.position_mm) + ")"});
    addGiven(out, "Segment", entry.part_name);
    out.push_back({"From rectal end", millimetres(marker.station_mm) + " along the centreline"});
    out.push_back({"From caecal end", millimetres(marker.from_caecum_mm) + " along the centreline"});
    out.push_back(
        {"Fraction", percent(marker.fraction) + " of the whole, " + millimetres(length_mm) + ", from the rectal end"});
    if (marker.size)
        out.push_back({"Size", sizeWords(*marker.size)});
    if (marker.density)
        out.push_back({"Density", densityWords(*marker.density)});
    addGiven(out, "Same finding", partnerNames(marker));
    out.push_back({"By endoscope", "estimated: " + endoscopeEstimate(marker.station_mm, entry.part_name)});
    return out;
}

bool isLossy(const ReportContent& content, const std::string& scan_id)
{
    for (const ScanEntry& entry : content.scans)
        if (entry.scan.id == scan_id)
            return entry.scan.series.lossy;
    return false;
}

}  // namespace vicon::report

// The one JSON form of what is known for a report, which is what a signature is over.
#include "json_fields.h"
#include "vicon/cases/report_content.h"
#include "vicon/core/json_text.h"

using nlohmann::json;

namespace vicon {
namespace {

json scanJson(const ScanRecord& scan)
{
    json out = {{"id", scan.id},
                {"series_uid", scan.series.uid},
                {"series_number", scan.series.number},
                {"description", scan.series.description},
                {"position", positionName(scan.series.patient_position)},
                {"patient_position", scan.series.patient_position},
                {"frame_of_reference_uid", scan.series.frame_of_reference_uid},
                {"slice_thickness_mm", scan.series.slice_thickness_mm},
                {"kernel", scan.series.kernel},
                {"lossy", scan.series.lossy}};
    if (quantityOf(scan.series) == Quantity::signal)
        out["modality"] = scan.series.modality;  // else CT
    return out;
}

template <class Category>
json categoryJson(const Proposal<Category>& proposal, const std::optional<Chosen<Category>>& chosen)
{
    json out = {{"reason", proposal.reason}};
    putName(out, "proposed", proposal.category);
    if (chosen) {
        out["chosen"] = nameOf(chosen->category);
        out["meaning"] = meaningOf(chosen->category);
        out["why"] = chosen->why;
    }
    return out;
}

ScanRecord scanFromContent(const json& from)
{
    ScanRecord scan;
    scan.id = from.at("id").get<std::string>();
    scan.series.uid = from.value("series_uid", "");
    scan.series.number = wholeNumber(from, "series_number", 0);
    scan.series.description = from.value("description", "");
    scan.series.patient_position = from.value("patient_position", "");
    scan.series.frame_of_reference_uid = from.value("frame_of_reference_uid", "");
    scan.series.slice_thickness_mm = from.value("slice_thickness_mm", 0.0);
    scan.series.kernel = from.value("kernel", "");
    scan.series.lossy = from.value("lossy", false);
    scan.series.modality = from.value("modality", "CT");
    return scan;
}

template <class Category>
Proposal<Category> proposalFrom(const json& from, Category (*value_of)(const std::string&))
{
    return {named(from, "proposed", value_of), from.value("reason", "")};
}

}  // namespace

json reportContent(const ReadCase& read)
{
    json out = {{"case", read.record.id},
                {"patient", read.record.patient},
                {"study", read.record.study},
                {"flags", read.record.flags},
                {"scans", json::array()},
                {"findings", json::array()},
                {"markers", json::array()},
                {"loose_markers", read.loose_markers},
                {"assessment", toJson(read.assessment)},
                {"comparisons", json::array()},
                {"distension", json::array()},
                {"c_rads",
                 {{"colon", categoryJson(read.colon_proposal, read.assessment.colon_category)},
                  {"extracolonic", categoryJson(read.extracolonic_proposal, read.assessment.extracolonic_category)}}}};
    for (const ScanRecord& scan : read.scans) {
        json entry = scanJson(scan);
        if (const auto given = read.given_lumens.find(scan.id); given != read.given_lumens.end())
            entry["given_lumen"] = toJson(given->second);
        out["scans"].push_back(entry);
    }
    for (const auto& [finding, facts] : read.findings) {
        json entry = toJson(finding);
        entry["facts"] = toJson(facts);
        out["findings"].push_back(entry);
    }
    for (const Marker& marker : read.markers)
        out["markers"].push_back(toJson(marker));
    for (const ComparedFinding& compared : read.comparisons) {
        json entry = toJson(compared.said);
        entry["now"] = toJson(compared.now);
        entry["growth"] = toJson(compared.growth);
        out["comparisons"].push_back(entry);
    }
    for (const PartState& part : read.parts)
        out["distension"].push_back({{"scan", part.scan_id},
                                     {"part", nameOf(part.part)},
                                     {"distension", nameOf(part.distension)},
                                     {"by_reader", part.by_reader}});
    return out;
}

ReadCase readCaseFromContent(const json& from)
{
    return understood("a report's content", [&] {
        ReadCase read;
        read.record.id = from.at("case").get<std::string>();
        read.record.patient = from.at("patient").get<Patient>();
        read.record.study = from.at("study").get<Study>();
        read.record.flags = from.at("flags").get<std::vector<std::string>>();
        for (const json& scan : from.at("scans")) {
            read.scans.push_back(scanFromContent(scan));
            read.scans.back().case_id = read.record.id;
            if (scan.contains("given_lumen"))
                read.given_lumens.emplace(read.scans.back().id, lumenOriginFromJson(scan["given_lumen"]));
        }
        for (const json& finding : from.at("findings"))
            read.findings.push_back({findingFromJson(finding), factsFromJson(finding.at("facts"))});
        for (const json& marker : from.at("markers"))
            read.markers.push_back(markerFromJson(marker));
        read.loose_markers = from.at("loose_markers").get<std::vector<std::string>>();
        read.assessment = assessmentFromJson(from.at("assessment"));
        for (const json& entry : from.value("comparisons", json::array())) {  // of VICON before there were any: none
            ComparedFinding compared{comparisonFromJson(entry), measuredSizeFromJson(entry.at("now")),
                                     growthFromJson(entry.at("growth"))};
            read.comparisons.push_back(std::move(compared));
        }
        for (const json& part : from.at("distension"))
            read.parts.push_back({part.at("scan").get<std::string>(), colonPartFrom(part.at("part").get<std::string>()),
                                  distensionFrom(part.at("distension").get<std::string>()),
                                  part.at("by_reader").get<bool>()});
        read.colon_proposal = proposalFrom(from.at("c_rads").at("colon"), colonCategoryFrom);
        read.extracolonic_proposal = proposalFrom(from.at("c_rads").at("extracolonic"), extracolonicCategoryFrom);
        return read;
    });
}

}  // namespace vicon

#include "case_tables.h"

#include <charconv>
#include <cstdio>
#include <set>
#include <sstream>

#include "text_table.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

std::string scansOf(const ReadCase& read, const FindingFacts& facts)
{
    std::set<std::string> seen;
    std::string out;
    for (const FindingSight& sight : facts.sights)
        for (const ScanRecord& scan : read.scans)
            if (scan.id == sight.scan_id && seen.insert(scan.id).second)
                out += (out.empty() ? "" : ", ") + positionName(scan.series.patient_position);
    return out.empty() ? "-" : out;
}

std::vector<std::string> rowOf(const ReadCase& read, const FindingWithFacts& entry)
{
    const auto& [finding, facts] = entry;
    const FindingSight* lead = facts.lead();
    std::string markers;
    for (const FindingSight& sight : facts.sights)
        markers += (markers.empty() ? "" : ", ") + sight.marker_id;
    return {finding.id,
            nameOf(finding.kind),
            facts.size_mm ? formatNumber(*facts.size_mm, 1) + " (" + nameOf(facts.size_source) + ")" : "-",
            lead && lead->part ? nameOf(*lead->part) : "-",
            lead ? formatNumber(lead->station_mm, 0) : "-",
            lead ? formatNumber(lead->from_caecum_mm, 0) : "-",
            lead && lead->clock_hour ? std::to_string(*lead->clock_hour) : "-",
            markers.empty() ? "-" : markers,
            scansOf(read, facts),
            finding.note};
}

template <class Category>
void printCategory(const char* of, const Proposal<Category>& proposal, const std::optional<Chosen<Category>>& chosen)
{
    std::printf("C-RADS %s: proposed %s: %s\n", of, proposal.category ? nameOf(*proposal.category).c_str() : "none",
                proposal.reason.c_str());
    if (chosen)
        std::printf("C-RADS %s: chosen %s, %s%s\n", of, nameOf(chosen->category).c_str(),
                    meaningOf(chosen->category).c_str(), chosen->why.empty() ? "" : (": " + chosen->why).c_str());
}

}  // namespace

std::vector<std::string> namesFrom(const std::string& text)
{
    constexpr const char* kBlanks = " \t";
    std::vector<std::string> out;
    std::istringstream list(text == "none" ? "" : text);
    for (std::string name; std::getline(list, name, ',');)
        if (const auto from = name.find_first_not_of(kBlanks); from != std::string::npos)
            out.push_back(name.substr(from, name.find_last_not_of(kBlanks) - from + 1));
    return out;
}

double numberFrom(const std::string& text, const char* option, double least, double most)
{
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most))
        throw Error(ErrorCode::wrong_use,
                    "'" + text + "' is no number from " + formatNumber(least, 0) + " to " + formatNumber(most, 0),
                    option);
    return value;
}

void printFindings(bool json, CaseStore& store, const ReadCase& read)
{
    const ReportStatus status = reportStatus(store, read.record.id);
    if (json) {
        nlohmann::json out = reportContent(read);
        out["state"] = nameOf(status.state);
        out["amending"] = status.amending;
        std::printf("%s\n", out.dump(2).c_str());
        return;
    }
    std::vector<std::vector<std::string>> rows;
    for (const FindingWithFacts& entry : read.findings)
        rows.push_back(rowOf(read, entry));
    if (rows.empty())
        std::printf("no findings; 'vicon finding %s --add MARKER' makes one\n", read.record.id.c_str());
    else
        std::printf("%s", formatTable({"ID", "KIND", "SIZE MM", "SEGMENT", "FROM RECTUM MM", "FROM CAECUM MM", "CLOCK",
                                       "MARKERS", "SCANS", "NOTE"},
                                      rows)
                              .c_str());
    if (!read.loose_markers.empty()) {
        std::string loose;
        for (const std::string& id : read.loose_markers)
            loose += " " + id;
        std::printf("markers not assigned to a finding:%s\n", loose.c_str());
    }
    printCategory("colon", read.colon_proposal, read.assessment.colon_category);
    printCategory("outside", read.extracolonic_proposal, read.assessment.extracolonic_category);
    std::printf("report: %s\n", textOf(status).c_str());
}

}  // namespace vicon::app

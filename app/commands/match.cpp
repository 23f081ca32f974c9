#include <algorithm>
#include <cstdio>

#include "../command.h"
#include "../text_table.h"
#include "vicon/cases/marker_groups.h"
#include "vicon/cases/pair_proposals.h"
#include "vicon/cases/prior_match.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct MatchArguments {
    std::string case_id, scan_id, confirm, take_back;
    double at_mm = 0, every_mm = 100;
    bool at_given = false;
};

/// The maps as they were asked for: from one scan to every other, else each once.
std::vector<ScanMatch> askedFor(const std::vector<ScanMatch>& matches, const std::string& scan_id)
{
    if (scan_id.empty())
        return matches;
    std::vector<ScanMatch> out;
    for (const ScanMatch& match : matches) {
        if (match.from_scan == scan_id)
            out.push_back(match);
        else if (match.to_scan == scan_id)
            out.push_back({match.to_scan, match.from_scan, match.map.reversed()});
    }
    return out;
}

const ScanColon& colonOf(const std::vector<ScanColon>& colons, const std::string& scan_id)
{
    for (const ScanColon& colon : colons)
        if (colon.scan_id == scan_id)
            return colon;
    throw Error(ErrorCode::internal, "a scan that was matched is gone", scan_id);
}

std::string titleOf(const ScanColon& colon)
{
    return colon.scan_id + " (" + colon.position + ", " + formatNumber(colon.length_mm, 0) + " mm)";
}

void printMatch(const ScanMatch& match, const std::vector<ScanColon>& colons, const MatchArguments& arguments)
{
    const ScanColon &from = colonOf(colons, match.from_scan), &to = colonOf(colons, match.to_scan);
    std::printf("%s in %s, by %s\n", titleOf(from).c_str(), titleOf(to).c_str(), nameOf(match.map.source).c_str());
    std::vector<double> stations;
    if (arguments.at_given)
        stations = {arguments.at_mm};
    else
        for (double at = 0; at <= match.map.from_length_mm; at += arguments.every_mm)
            stations.push_back(at);
    std::vector<std::vector<std::string>> rows;
    const auto partOf = [](const ScanColon& colon, double station_mm) {
        return colon.parts.empty() ? "-" : partNameAt(colon.parts, station_mm);
    };
    for (const double at : stations) {
        const StationInterval there = match.map.at(at);
        rows.push_back({formatNumber(at, 0), partOf(from, at), formatNumber(there.station_mm, 0),
                        formatNumber(there.least_mm, 0), formatNumber(there.most_mm, 0), partOf(to, there.station_mm)});
    }
    std::printf("%s", formatTable({"AT MM", "SEGMENT", "THERE MM", "LEAST", "MOST (80 %)", "SEGMENT"}, rows).c_str());
}

void printProposals(const std::vector<PairProposal>& proposals)
{
    if (proposals.empty())
        return;
    std::printf("markers that may be one finding; '--confirm M=M' pairs them\n");
    std::vector<std::vector<std::string>> rows;
    for (const PairProposal& p : proposals)
        rows.push_back({p.first + "=" + p.second, std::to_string(p.rank), p.reason});
    std::printf("%s", formatTable({"PAIR", "RANK", "WHY"}, rows).c_str());
}

/// "m1=m4": two markers of the case.
std::pair<Marker, Marker> markersFrom(CaseStore& store, const std::string& case_id, const std::string& text)
{
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
        throw Error(ErrorCode::wrong_use, "not two markers", "'" + text + "'", "write m1=m4");
    const Marker first = store.requireMarker(case_id, text.substr(0, equals));
    const Marker second = store.requireMarker(case_id, text.substr(equals + 1));
    return {first, second};
}

void setPair(CaseStore& store, const std::string& case_id, const MatchArguments& arguments)
{
    const bool confirm = !arguments.confirm.empty();
    const auto [first, second] = markersFrom(store, case_id, confirm ? arguments.confirm : arguments.take_back);
    if (confirm) {
        store.editMarkers(case_id, pairingEdits(store.markers(case_id), first, second));
        return;
    }
    if (std::count(first.partners.begin(), first.partners.end(), second.id) == 0)
        throw Error(ErrorCode::wrong_use, "these two are no pair", "'" + arguments.take_back + "'");
    Marker parted = second;  // of more than two the others stay together
    parted.partners.clear();
    store.editMarkers(case_id, {{second, parted}});
}

int match(Context& context, const MatchArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const bool pairs = !(arguments.confirm + arguments.take_back).empty();
    const std::string case_id = requireCase(store, arguments.case_id, pairs ? IdPart::whole : IdPart::beginning).id;
    if (!arguments.scan_id.empty())
        store.requireScan(case_id, arguments.scan_id);
    if (pairs) {
        context.require(Role::mark);
        setPair(store, case_id, arguments);
    }
    const std::vector<ScanMatch> all = matchesOf(store, case_id), matches = askedFor(all, arguments.scan_id);
    const std::vector<PairProposal> proposals = proposePairs(store.markers(case_id), all);
    if (context.json) {
        nlohmann::json out = {{"maps", nlohmann::json::array()}, {"proposed_pairs", nlohmann::json::array()}};
        for (const ScanMatch& one : matches)
            out["maps"].push_back(toJson(one));
        for (const PairProposal& proposal : proposals)
            out["proposed_pairs"].push_back(toJson(proposal));
        std::printf("%s\n", out.dump(2).c_str());
        return 0;
    }
    const std::vector<ScanColon> colons = colonsOf(store, case_id);
    for (const ScanMatch& one : matches)
        printMatch(one, colons, arguments);
    if (matches.empty())
        std::printf("no two scans of this case have a centreline\n");
    printProposals(proposals);
    return 0;
}

}  // namespace

Subcommand matchCommand()
{
    return {
        "match", "Find the same places of a case's scans, and markers that may be one finding",
        [](CommandLine& command) {
            auto a = std::make_shared<MatchArguments>();
            command.option("CASE", a->case_id, "The case's id, whole to change something").required();
            command.option("--scan", a->scan_id, "From this scan to every other (default: each pair once)")
                .typeName("SCAN");
            const auto at =
                command.option("--at", a->at_mm, "Where this station lies").typeName("MM").check(range(0.0, 10000.0));
            command.option("--every", a->every_mm, "Distance of the stations that are listed")
                .typeName("MM")
                .check(range(1.0, 1000.0))
                .captureDefault()
                .excludes(at);
            const auto confirm =
                command.option("--confirm", a->confirm, "These two markers are one finding").typeName("M=M");
            command.option("--take-back", a->take_back, "They are not").typeName("M=M").excludes(confirm);
            return [a, at](Context& context) {
                a->at_given = at.given();
                return match(context, *a);
            };
        }};
}

}  // namespace vicon::app

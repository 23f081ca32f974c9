#include "vicon/cases/prior_match.h"

#include <algorithm>
#include <cmath>

#include "landmarks.h"
#include "vicon/cases/step_results.h"

namespace vicon {
namespace {

/// The sight whose position is that of the scan.
const PriorSight* sightFor(const PriorReport& report, const PriorFinding& finding, const ScanColon& scan)
{
    for (const PriorSight& sight : finding.sights)
        if (const PriorScan* then = report.scan(sight.series_uid); then && then->position == scan.position)
            return &sight;
    return finding.lead();
}

/// What may become one another. Stool moves, and a valve stays what it is.
bool ofAKind(std::optional<FindingKind> then, FindingKind now)
{
    const auto grows = [](FindingKind kind) {
        return kind == FindingKind::polyp || kind == FindingKind::mass || kind == FindingKind::indeterminate ||
               kind == FindingKind::other;
    };
    return !then || (grows(*then) && grows(now)) || (*then == now && now != FindingKind::stool);
}

/// Of the finding's sights the one that lies nearest to the expected place; nothing where all lie beyond the window.
std::optional<PriorCandidate> candidateFor(const PriorReport& report, const PriorFinding& prior,
                                           const FindingWithFacts& now, const std::vector<ScanColon>& colons,
                                           const PriorOptions& options)
{
    std::optional<PriorCandidate> nearest;
    for (const FindingSight& sight : now.facts.sights)
        for (const ScanColon& colon : colons) {
            if (colon.scan_id != sight.scan_id)
                continue;
            const auto place = expectedIn(report, prior, colon, options);
            if (!place || sight.station_mm < place->least_mm || sight.station_mm > place->most_mm)
                continue;
            const double off_mm = sight.station_mm - place->station_mm;
            if (!nearest || std::abs(off_mm) < std::abs(nearest->off_mm))
                nearest = PriorCandidate{now.finding.id, off_mm, place->by};
        }
    return nearest;
}

}  // namespace

std::vector<ScanColon> colonsOf(CaseStore& store, const std::string& case_id)
{
    std::vector<ScanColon> out;
    for (const ScanRecord& scan : store.scans(case_id)) {
        const StepResults results = resultsOf(store.steps(case_id, scan.id));
        if (results.skeleton && results.skeleton->length_mm > 0)
            out.push_back(
                {scan.id, positionName(scan.series.patient_position), results.skeleton->length_mm, results.parts()});
    }
    return out;
}

std::optional<ExpectedPlace> expectedIn(const PriorReport& report, const PriorFinding& finding, const ScanColon& scan,
                                        const PriorOptions& options)
{
    const PriorSight* sight = sightFor(report, finding, scan);
    if (!sight)
        return std::nullopt;
    const ColonPartRange* range = sight->part ? rangeOf(scan.parts, *sight->part) : nullptr;
    const double window_mm = options.window_percent / 100 * scan.length_mm;
    const auto around = [&](double station_mm, double half_mm, const std::string& by) {
        return ExpectedPlace{station_mm, station_mm - half_mm, station_mm + half_mm, by};
    };
    if (range && sight->part_fraction)
        return around(std::lerp(range->from_mm, range->to_mm, *sight->part_fraction), window_mm,
                      "fraction inside the " + nameOf(range->part));
    if (sight->fraction)
        return around(*sight->fraction * scan.length_mm, window_mm, "fraction of the whole colon");
    if (range)
        return around((range->from_mm + range->to_mm) / 2, (range->to_mm - range->from_mm) / 2 + window_mm,
                      "anywhere in the " + nameOf(range->part));
    return std::nullopt;
}

std::vector<PriorMatch> matchFindings(const PriorReport& report, const std::vector<FindingWithFacts>& findings,
                                      const std::vector<ScanColon>& colons, const PriorOptions& options)
{
    std::vector<PriorMatch> matches;
    std::map<std::string, int> times;  // a finding of today is a candidate
    for (const PriorFinding& prior : report.findings) {
        PriorMatch match{report.sop_uid, prior.uid, {}, false};
        for (const FindingWithFacts& now : findings)
            if (ofAKind(prior.kind, now.finding.kind))
                if (auto candidate = candidateFor(report, prior, now, colons, options)) {
                    ++times[candidate->finding_id];
                    match.candidates.push_back(std::move(*candidate));
                }
        std::stable_sort(match.candidates.begin(), match.candidates.end(),
                         [](const auto& a, const auto& b) { return std::abs(a.off_mm) < std::abs(b.off_mm); });
        matches.push_back(std::move(match));
    }
    for (PriorMatch& match : matches)
        match.alone = match.candidates.size() == 1 && times[match.candidates.front().finding_id] == 1;
    return matches;
}

}  // namespace vicon

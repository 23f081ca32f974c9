#include "vicon/cases/pair_proposals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include "vicon/cases/case_store.h"
#include "vicon/cases/finding_facts.h"
#include "vicon/cases/marker_groups.h"
#include "vicon/cases/step_results.h"
#include "vicon/scan_files/stored_volume.h"

namespace vicon {
namespace {

constexpr double kWithin = 1.2816;          // standard deviations to either side hold 80 %
constexpr double kLeastDeviation_mm = 4;    // of a place: a marker is set on a finding's side, not in its middle
constexpr double kSlip = 4, kSlip_mm = 30;  // the map may have taken one fold for the next, 20 to 35 mm on
constexpr double kSizeDeviation = 0.25;     // of the logarithm of a size from one scan to the other
constexpr double kMostCost = 9;             // three standard deviations: beyond it two markers are not compared
constexpr double kAboutAsWell = 2;          // of cost

std::optional<double> sizeOf(const Marker& marker)
{
    if (!marker.size)
        return std::nullopt;
    const double size_mm = largestDiameter_mm(*marker.size);
    return size_mm > 0 ? std::optional(size_mm) : std::nullopt;
}

std::string worded(const PairProposal& proposal, const StationInterval& place, const Marker& first,
                   const Marker& second)
{
    const std::optional<double> a = sizeOf(first), b = sizeOf(second);
    char text[160];
    std::snprintf(text, sizeof text, "%.0f mm from the same place, %s the interval of %.0f mm",
                  std::abs(proposal.off_mm), proposal.within ? "within" : "outside", place.most_mm - place.least_mm);
    std::string words = text;
    if (a && b) {
        std::snprintf(text, sizeof text, "; %.1f and %.1f mm", *a, *b);
        words += text;
    }
    for (const Marker* marker : {&first, &second})
        if (!marker->partners.empty())
            words += "; " + marker->id + " is paired with " + partnerNames(*marker);
    if (proposal.rivals > 0)
        words += proposal.rivals == 1 ? "; one other fits about as well"
                                      : "; " + std::to_string(proposal.rivals) + " others fit about as well";
    return words;
}

struct Candidate {
    PairProposal proposal;
    StationInterval place;
    Marker first, second;
};

/// Where a marker of the same finding lies.
StationInterval markerAt(StationInterval place)
{
    place.least_mm = std::min(place.least_mm, place.station_mm - kLeastDeviation_mm);
    place.most_mm = std::max(place.most_mm, place.station_mm + kLeastDeviation_mm);
    return place;
}

std::optional<Candidate> candidateOf(const Marker& first, const Marker& second, const StationMap& map)
{
    Candidate c{{first.id, second.id}, markerAt(map.at(first.station_mm)), first, second};
    const std::optional<double> first_mm = sizeOf(first), second_mm = sizeOf(second);
    PairProposal& p = c.proposal;
    p.off_mm = second.station_mm - c.place.station_mm;
    p.within = second.station_mm >= c.place.least_mm && second.station_mm <= c.place.most_mm;
    const double side_mm = p.off_mm < 0 ? c.place.station_mm - c.place.least_mm : c.place.most_mm - c.place.station_mm;
    p.cost = std::min(std::pow(p.off_mm / std::hypot(side_mm / kWithin, kLeastDeviation_mm), 2),
                      kSlip + std::pow(p.off_mm / kSlip_mm, 2));
    if (first_mm && second_mm)
        p.cost += std::pow(std::log(*second_mm / *first_mm) / kSizeDeviation, 2);
    return p.cost <= kMostCost ? std::optional(c) : std::nullopt;
}

/// Ranks by cost; who is best with another is not best here.
void rank(std::vector<Candidate>& candidates)
{
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.proposal.cost < b.proposal.cost; });
    std::map<std::string, int> times;
    std::set<std::string> taken;
    for (Candidate& c : candidates) {
        PairProposal& p = c.proposal;
        const bool free = !taken.contains(p.first) && !taken.contains(p.second);
        int& before = times[p.first];
        if (free) {
            taken.insert(p.first);
            taken.insert(p.second);
        } else if (before == 0) {
            before = 1;  // the first place stays empty
        }
        p.rank = ++before;
        for (const Candidate& other : candidates)
            p.rivals += &other != &c && (other.proposal.first == p.first || other.proposal.second == p.second) &&
                        other.proposal.cost < p.cost + kAboutAsWell;
        p.reason = worded(p, c.place, c.first, c.second);
    }
}

nlohmann::json toJson(const StationMap& map)
{
    nlohmann::json stations = nlohmann::json::array();
    for (std::size_t n = 0; n < map.from_mm.size(); ++n)
        stations.push_back({{"from_mm", map.from_mm[n]},
                            {"to_mm", map.to[n].station_mm},
                            {"least_mm", map.to[n].least_mm},
                            {"most_mm", map.to[n].most_mm}});
    return stations;
}

}  // namespace

std::vector<ScanMatch> matchesOf(CaseStore& store, const std::string& case_id, const Progress* wanted)
{
    const std::map<std::string, Skeleton> skeletons = skeletonsOf(store, case_id);
    std::vector<std::pair<std::string, ColonProfile>> profiles;
    for (const ScanRecord& scan : store.scans(case_id)) {
        if (wanted)
            wanted->check();
        const auto skeleton = skeletons.find(scan.id);
        if (skeleton == skeletons.end() || skeleton->second.empty())
            continue;
        const StepResults results = resultsOf(store.steps(case_id, scan.id));
        const LumenAlong along =
            results.quality && results.quality->quality ? results.quality->quality->along : LumenAlong();
        ColonProfile profile = profileOf(skeleton->second, results.parts(), along);
        if (const auto inside = store.scanFolder(case_id, scan.id) / "inside.mha"; std::filesystem::exists(inside))
            profile.relief = reliefOf(scan_files::StoredVolume<std::uint8_t>(inside).view(), skeleton->second, wanted);
        profiles.emplace_back(scan.id, std::move(profile));
    }
    std::vector<ScanMatch> matches;
    for (std::size_t a = 0; a < profiles.size(); ++a)
        for (std::size_t b = a + 1; b < profiles.size(); ++b)
            matches.push_back(
                {profiles[a].first, profiles[b].first, matchStations(profiles[a].second, profiles[b].second, wanted)});
    return matches;
}

nlohmann::json toJson(const ScanMatch& match)
{
    return {{"from_scan", match.from_scan},           {"to_scan", match.to_scan},
            {"by", nameOf(match.map.source)},         {"from_length_mm", match.map.from_length_mm},
            {"to_length_mm", match.map.to_length_mm}, {"stations", toJson(match.map)}};
}

bool mayBePaired(const std::vector<Marker>& markers)
{
    for (auto first = markers.begin(); first != markers.end(); ++first)
        for (auto second = first + 1; second != markers.end(); ++second)
            if (mayBeOneFinding(markers, *first, *second))
                return true;
    return false;
}

std::vector<PairProposal> proposePairs(const std::vector<Marker>& markers, const std::vector<ScanMatch>& matches)
{
    std::vector<PairProposal> proposals;
    for (const ScanMatch& match : matches) {
        std::vector<Candidate> candidates;
        for (const Marker& first : markers)
            for (const Marker& second : markers)
                if (first.scan_id == match.from_scan && second.scan_id == match.to_scan &&
                    mayBeOneFinding(markers, first, second))
                    if (const auto candidate = candidateOf(first, second, match.map))
                        candidates.push_back(*candidate);
        rank(candidates);
        for (const Candidate& c : candidates)
            proposals.push_back(c.proposal);
    }
    std::stable_sort(proposals.begin(), proposals.end(), [](const auto& a, const auto& b) {
        return std::pair(a.rank, a.cost) < std::pair(b.rank, b.cost);
    });
    return proposals;
}

nlohmann::json toJson(const PairProposal& proposal)
{
    return {{"first", proposal.first},   {"second", proposal.second}, {"off_mm", proposal.off_mm},
            {"within", proposal.within}, {"cost", proposal.cost},     {"rank", proposal.rank},
            {"rivals", proposal.rivals}, {"reason", proposal.reason}};
}

}  // namespace vicon

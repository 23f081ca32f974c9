#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vicon/cases/marker.h"
#include "vicon/cases/station_map.h"
#include "vicon/core/progress.h"

namespace vicon {

class CaseStore;

/// The stations of one scan of a case in another.
struct ScanMatch {
    std::string from_scan, to_scan;
    StationMap map;
};
/// Of every two scans whose centreline was found, each once, in the case's order: of three scans three. Throws
/// Error{cancelled} where `wanted` is no longer.
std::vector<ScanMatch> matchesOf(CaseStore& store, const std::string& case_id, const Progress* wanted = nullptr);
/// As docs/dev/schemas/match.schema.json has it.
nlohmann::json toJson(const ScanMatch& match);

/// Two markers of two scans that may be one finding. A reader says whether they are: nothing is paired by itself.
struct PairProposal {
    std::string first, second;  ///< ids of the markers, in the order of the case's scans
    double off_mm = 0;          ///< how far the second lies from where the first should be, towards the caecum
    bool within = false;        ///< inside the interval of 80 %
    double cost = 0;            ///< squared deviations of place, size and side added up: 0 is a perfect fit
    int rank = 0;               ///< among the candidates of the first marker in that scan, 1 the best
    int rivals = 0;             ///< other candidates of either marker that fit about as well
    std::string reason;         ///< in words
};
/// Whether there are markers of two scans that may be one finding: else there is nothing to propose, and no need of
/// maps.
bool mayBePaired(const std::vector<Marker>& markers);
/// Of all markers but those that are paired with one of the other scan already: those of two scans that may lie in one
/// place, the best first. A marker is in at most one proposal of rank 1 with another scan.
std::vector<PairProposal> proposePairs(const std::vector<Marker>& markers, const std::vector<ScanMatch>& matches);
nlohmann::json toJson(const PairProposal& proposal);

}  // namespace vicon

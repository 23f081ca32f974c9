#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"

namespace vicon {

struct MarkOptions {
    double most_distance_mm = 10;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("mark.most_distance_mm", most_distance_mm, "mm", "A marker farther than this outside the lumen is refused.",
          {0, 100});
    }
};

/// The parts of a scan's colon; empty where they are not known.
ColonPartRanges partsOf(CaseStore& store, const ScanRecord& scan);

class ScanPlaces;
struct SnappedPoint;

/// Places markers of a case, several at the cost of one: what it needs of a scan it reads once, when it first does.
class MarkerPlacer {
public:
    MarkerPlacer(CaseStore& store, const MarkOptions& options, std::string case_id);
    ~MarkerPlacer();
    MarkerPlacer(const MarkerPlacer&) = delete;
    MarkerPlacer& operator=(const MarkerPlacer&) = delete;

    /// Fills in a marker's scan, stations, fraction and part of the colon, and takes off it what was measured at
    /// another place. An empty scan id is found: the only scan whose lumen is near the point. Throws Error{bad_input}
    /// when the point is outside, Error{wrong_use} when it could be in several scans, Error{not_ready} when its scan
    /// has not been through the pipeline.
    Marker place(Marker marker);

private:
    struct Scan;
    struct Found;
    const ScanPlaces& placesOf(Scan& scan);
    Found find(const Marker& marker);

    CaseStore& store_;
    const MarkOptions options_;
    const std::string case_id_;
    std::vector<Scan> scans_;
};

/// One marker, as MarkerPlacer::place().
Marker placeMarker(CaseStore& store, const MarkOptions& options, const std::string& case_id, Marker marker);

/// The change that adds the markers of a file, {"markers": [...]}, each placed as MarkerPlacer::place() does; an id
/// that the case has is replaced. Throws Error{bad_input} when the file makes no sense, Error{cancelled} once it is,
/// and as MarkerPlacer::place().
std::vector<MarkerEdit> importOf(CaseStore& store, const MarkOptions& options, const std::string& case_id,
                                 const std::filesystem::path& file, Progress& progress);

/// Places markers anew, after a skeleton was made again: those of a scan, of all scans where `scan_id` is empty.
/// Returns the ids of those that no longer lie in the colon: they stay as they are.
std::vector<std::string> renewPlaces(CaseStore& store, const MarkOptions& options, const std::string& case_id,
                                     const std::string& scan_id = {});

/// Takes a sample of the tissue around a placed marker, of what circleWall() encloses, and keeps it with the marker.
/// Throws Error{wrong_use} where the radius is out of range or the ball holds too little tissue, Error{bad_input} where
/// it holds no wall.
void addDensity(CaseStore& store, const std::string& case_id, Marker& marker, double radius_mm);

/// Outlines the polyp under a placed marker and keeps its size with the marker. Throws Error{wrong_use} where it has no
/// edge of its own.
void addPolypSize(CaseStore& store, const std::string& case_id, Marker& marker);

/// Whether the pipeline made what markers and pictures need of a scan.
bool isPrepared(const std::filesystem::path& scan_folder);

/// The first scan of the case that has been through the pipeline; the named one when `scan_id` is not empty.
/// Throws Error{not_ready} or Error{not_found}.
ScanRecord requirePreparedScan(CaseStore& store, const std::string& case_id, const std::string& scan_id);

}  // namespace vicon

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/options.h"

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

/// Where a point of space lies in a scan's colon.
struct SnappedPoint {
    double outside_mm = 0;  ///< distance to the nearest inside voxel; 0 within the lumen
    double station_mm = 0;
    double length_mm = 0;  ///< of the skeleton
};

/// Finds a point's place along the skeleton, without jumping to a neighbouring loop: the nearest inside voxel's segment
/// says which part of the curve is meant. Nothing when the point is farther than `within_mm` from the lumen. Throws
/// Error{not_ready} when the scan has not been through the pipeline.
std::optional<SnappedPoint> snapToSkeleton(const std::filesystem::path& scan_folder, Point3 point, double within_mm);

/// The parts of a scan's colon; empty where they are not known.
ColonPartRanges partsOf(CaseStore& store, const ScanRecord& scan);

/// Fills in a marker's scan, stations, fraction and part of the colon, and takes off it what was measured at another
/// place. An empty scan id is found: the only scan whose lumen is near the point. Throws Error{bad_input} when the
/// point is outside, Error{wrong_use} when it could be in several scans.
Marker placeMarker(CaseStore& store, const MarkOptions& options, const std::string& case_id, Marker marker);

/// The change that adds the markers of a file, {"markers": [...]}, each placed as placeMarker() does; an id that the
/// case has is replaced. Throws Error{bad_input} when the file makes no sense, and as placeMarker().
std::vector<MarkerEdit> importOf(CaseStore& store, const MarkOptions& options, const std::string& case_id,
                                 const std::filesystem::path& file);

/// Places the markers of a scan anew, after its skeleton was made again. One that no longer lies in the colon, and what
/// somebody changes at the same time, stays as it is.
void renewPlaces(CaseStore& store, const MarkOptions& options, const std::string& case_id, const std::string& scan_id);

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

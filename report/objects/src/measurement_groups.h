#pragma once

#include <map>

#include "source_images.h"
#include "sr_tree.h"
#include "vicon/cases/report_content.h"

namespace vicon::report {

/// The image that shows each marker.
using MarkerImages = std::map<std::string, SourceImage>;

/// Adds a measurement group (TID 1501) for every sight of every finding; those of one finding bear the same tracking
/// UID. What belongs to the finding as a whole stands with the sight that leads.
void addFindings(SrTree& tree, const ReadCase& read, const MarkerImages& images);

/// A scan's centreline.
struct Centreline {
    ScanRecord scan;
    std::vector<Point3> points_mm;  ///< from the rectum, bridges over collapsed parts included; at least two
    double length_mm = 0;
};
/// Adds a measurement group for each: the line in the scan's frame of reference, and its length.
void addCentrelines(SrTree& tree, const std::vector<Centreline>& centrelines);

}  // namespace vicon::report

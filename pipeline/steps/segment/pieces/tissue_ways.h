#pragma once

#include <vector>

#include "segment/body.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// The cheapest way through the tissue between two points.
struct TissueWay {
    double cost = 1e9;  ///< millimetres of soft tissue; larger than any real way when there is none
    std::vector<Point3> path_mm;
};

/// What a millimetre costs in each coarse voxel of the body: gas and fluid little, a collapsed bowel's soft tissue 1,
/// fat more, lung and gas that is no bowel most; bone cannot be crossed (0).
Volume<float> tissueCosts(const Body& body, const InsideVolume& labels, const WallDensities& densities);

/// Cheapest ways from one point to several.
std::vector<TissueWay> waysFrom(const Volume<float>& costs, Point3 from, const std::vector<Point3>& to,
                                Progress& progress);

}  // namespace vicon::steps

#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/viewer/model/coverage.h"
#include "vicon/viewer/model/view_pose.h"

namespace vicon::viewer {

/// A connected piece of the wall that has not been seen.
struct UnseenPatch {
    double area_mm2 = 0;
    Point3 centre_mm;       ///< LPS; on the wall, the middle of the triangle nearest to the piece's middle
    double station_mm = 0;  ///< of the nearest point of the path in the loop that the view looks at
    ViewPose view;          ///< a place from which the centre is looked at
    std::vector<std::uint32_t> triangles;  ///< ascending
};

/// Missed regions of this area and more are listed, and told before a report is signed. A reading that ends with the
/// list of what is this large shows 97.9 % of the wall after 21 s more.
inline constexpr double kMissedRegion_mm2 = 300;

/// Smaller unseen pieces are not listed: a polyp of 6 mm, the least that is reported, hides behind a disc of 6 mm.
inline constexpr double kLeastUnseen_mm2 = 28;

/// The areas of the unseen pieces of a surface, in no order; quicker than unseenPatches(), and throws as that does.
std::vector<double> unseenAreas_mm2(const std::vector<std::uint32_t>& triangles, const Coverage& coverage,
                                    const Progress* wanted = nullptr);

/// The unseen pieces of a surface, the largest first. Triangles belong to one piece when they share an edge; so pieces
/// cross the borders of cells, and single triangles too thin for any pixel do not join what lies around them.
/// @param points_mm x, y, z of each point, LPS
/// @param triangles three point numbers each, as many triangles as `coverage` has
/// @param least_area_mm2 smaller pieces are left out
/// Throws Error{bad_input} when the coverage is one of another surface, Error{cancelled} where `wanted`, if there is
/// one, says so, and as poseForPoint() does.
std::vector<UnseenPatch> unseenPatches(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles,
                                       const Coverage& coverage, const Skeleton& skeleton, const PathFrames& path,
                                       const Lumen& lumen, double least_area_mm2 = kLeastUnseen_mm2,
                                       const Progress* wanted = nullptr);

}  // namespace vicon::viewer

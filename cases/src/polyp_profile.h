#pragma once

#include <optional>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// A section of a polyp in a half plane from its axis: how far out, how high, and how it bends.
struct PolypProfile {
    static constexpr double kStep_mm = 0.25;  ///< along the section, from point to point

    std::vector<Point3> points;
    std::vector<double> out_mm, up_mm;  ///< of each point
    std::vector<double> turned;         ///< the direction's angle: 0 outwards, negative down
    std::vector<double> bend;           ///< its change per mm, smoothed: negative convex, positive concave
};

/// @param line the section, from the axis outwards
/// @param top on the axis, at height 0
PolypProfile polypProfileOf(const std::vector<Point3>& line, Point3 top, Vector3 axis, Vector3 out);

/// Number of the profile's point at the rim: where it turns concave the most behind its first steep part. Nothing where
/// it never does.
std::optional<std::size_t> rimOf(const PolypProfile& profile);

/// Whether a place in the section's plane lies in the head, or within `beside_mm` of it: between the section up to the
/// rim, the axis and the line from the rim to `base_mm` on the axis.
bool headHolds(const PolypProfile& profile, std::size_t rim, double base_mm, double out_mm, double up_mm,
               double beside_mm);

}  // namespace vicon

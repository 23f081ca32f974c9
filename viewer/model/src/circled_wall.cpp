#include "vicon/viewer/model/circled_wall.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vicon/viewer/model/peeling.h"

namespace vicon::viewer {
namespace {

constexpr double kMargin_mm = 2;  // that a sample keeps to the lumen

/// How far the wall around the surface lies behind it, in the middle of all its places on a ring; below 0: before it.
/// @param most_mm where there is none so near
double behind_mm(const Lumen& lumen, const CircledWall& at, double ring_mm, double most_mm)
{
    constexpr int kPlaces = 24;
    const double lift_mm = 2 * lumen.voxel_mm();  // rays begin in the lumen, over the surface
    const Vector3 other = std::abs(at.inwards.x) < 0.7 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    const Vector3 across = normalized(cross(at.inwards, other)), aside = cross(at.inwards, across);
    std::vector<double> all_mm;
    for (int n = 0; n < kPlaces; ++n) {
        const double angle = 2 * std::numbers::pi * n / kPlaces;
        const Vector3 out = across * std::cos(angle) + aside * std::sin(angle);
        const Point3 over = at.surface_mm + out * ring_mm - at.inwards * lift_mm;
        const double far_mm =
            lumen.inside(over)
                ? distanceToWall_mm(lumen, over, at.inwards, lift_mm + most_mm).value_or(lift_mm + most_mm)
                : 0;
        all_mm.push_back(far_mm - lift_mm);
    }
    const auto half = all_mm.begin() + kPlaces / 2;
    std::nth_element(all_mm.begin(), half, all_mm.end());
    return *half;
}

}  // namespace

std::optional<CircledWall> circledWall(const Lumen& lumen, Point3 middle, double radius_mm)
{
    const Lumen::Nearest nearest = lumen.nearestInside(middle, radius_mm + kMargin_mm);
    if (!nearest.found || nearest.distance_mm <= 0)
        return std::nullopt;
    CircledWall wall{nearest.position_mm, (middle - nearest.position_mm) / nearest.distance_mm, 0};
    const double far_side_mm = nearest.distance_mm + radius_mm;
    // The circle may lie within the finding: rings around it meet the wall that it stands on.
    for (const double ring : {1.0, 1.5, 2.0})
        wall.raised_mm = std::max(wall.raised_mm, behind_mm(lumen, wall, ring * radius_mm, far_side_mm));
    return wall;
}

}  // namespace vicon::viewer

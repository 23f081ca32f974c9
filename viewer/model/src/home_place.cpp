#include "vicon/viewer/model/home_place.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vicon/core/error.h"
#include "vicon/viewer/model/peeling.h"

namespace vicon::viewer {
namespace {

constexpr int kDirections = 400;
constexpr double kRayReach_mm = 500;
constexpr Vector3 kUpOfHome{0, -1, 0};

/// One of directions that are spread evenly over the sphere (Fibonacci's spiral).
Vector3 directionOf(int n)
{
    const double z = 1 - (2 * n + 1.0) / kDirections, turn = n * std::numbers::pi * (3 - std::sqrt(5.0));
    const double flat = std::sqrt(1 - z * z);
    return {flat * std::cos(turn), flat * std::sin(turn), z};
}

}  // namespace

PathFrame homePlace(const Lumen& lumen, const FieldView& wall_distance)
{
    const auto& voxels = wall_distance.voxels;
    const auto widest = std::max_element(voxels.begin(), voxels.end());
    if (widest == voxels.end() || !(*widest > 0))
        throw Error(ErrorCode::unusable_scan, "there is no lumen to fly in", {},
                    "run 'vicon work' to prepare the scan anew");
    PathFrame home;
    home.position_mm = wall_distance.grid.pointAt(wall_distance.grid.indexOf(std::size_t(widest - voxels.begin())));
    home.radius_mm = double(*widest);
    double deepest_mm = 0;
    for (int n = 0; n < kDirections; ++n) {
        const double free_mm =
            distanceToWall_mm(lumen, home.position_mm, directionOf(n), kRayReach_mm).value_or(kRayReach_mm);
        if (free_mm > deepest_mm) {
            deepest_mm = free_mm;
            home.forward = directionOf(n);
        }
    }
    home.up = uprightOn(home.forward, kUpOfHome);
    return home;
}

std::optional<Point3> roomiestAlong(const Lumen& lumen, Point3 on_line, Vector3 unit_direction)
{
    std::optional<Point3> best;
    double most_mm = 0;
    for (double at_mm = -kRayReach_mm; at_mm <= kRayReach_mm; at_mm += lumen.voxel_mm()) {
        const Point3 p = on_line + unit_direction * at_mm;
        if (const double room_mm = lumen.clearance_mm(p); room_mm > most_mm && lumen.inside(p)) {
            most_mm = room_mm;
            best = p;
        }
    }
    return best;
}

}  // namespace vicon::viewer

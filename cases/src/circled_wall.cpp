#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface_patch.h"
#include "vicon/cases/density_sample.h"

namespace vicon {
namespace {

constexpr double kCircledWall_mm = 40;  // of the wall that is looked at, as an outline's
constexpr int kCircleSections = 24;     // half planes around the axis
/// Of the wall whose mean normal says where the lumen is: the finding and what it stands on.
constexpr double kWithWallAround = 1.5;
constexpr double kAroundPoint_mm = 2;

/// How deep below the top the section first lies as far from the axis as the circle.
std::optional<double> depthAtCircle_mm(const std::vector<Point3>& section, Point3 top, Vector3 up, Vector3 out,
                                       double radius_mm)
{
    const auto at_circle =
        std::find_if(section.begin(), section.end(), [&](Point3 p) { return dot(p - top, out) >= radius_mm; });
    if (at_circle == section.end())
        return {};
    return -dot(*at_circle - top, up);
}

}  // namespace

CircledWall circleWall(const CellSurface& surface, Point3 at, double radius_mm)
{
    const SurfacePatch patch(surface, at, kCircledWall_mm, radius_mm);
    Vector3 up = patch.normalNear(at, kWithWallAround * radius_mm);
    if (length(up) == 0)
        up = patch.normalNear(patch.nearest_mm(), kAroundPoint_mm);
    const Point3 top = patch.highest(at, up, std::max(1.0, radius_mm / 4));
    const Vector3 across = anyAcross(up), aside = cross(up, across);
    const std::optional<std::size_t> start = patch.onAxis(top, up);
    std::vector<double> below_mm;
    for (int n = 0; n < kCircleSections; ++n) {
        const double angle = 2 * std::numbers::pi * n / kCircleSections;
        const Vector3 out = across * std::cos(angle) + aside * std::sin(angle);
        const auto section = start ? patch.section(*start, up, out, kCircledWall_mm) : std::vector<Point3>();
        if (const auto depth_mm = depthAtCircle_mm(section, top, up, out, radius_mm))
            below_mm.push_back(*depth_mm);
    }
    CircledWall wall{top, up * -1};
    if (below_mm.empty())
        return wall;
    const auto middle = below_mm.begin() + std::ptrdiff_t(below_mm.size() / 2);
    std::nth_element(below_mm.begin(), middle, below_mm.end());
    wall.raised_mm = std::clamp(*middle, 0.0, radius_mm);
    return wall;
}

}  // namespace vicon

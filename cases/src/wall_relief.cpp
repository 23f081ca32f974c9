#include "vicon/cases/wall_relief.h"

#include <cmath>
#include <numbers>

namespace vicon {
namespace {

constexpr double kFarthest_mm = 50;  // what a ray along the colon sees beyond is no wall of this place
constexpr double kRay_mm = 0.25;     // a third of the finest voxel
constexpr double kTangent_mm = 12;   // of the centreline that a direction is taken over

float radiusAlong(const InsideView& inside, Point3 from, Vector3 direction)
{
    double radius = 0;
    while (radius < kFarthest_mm &&
           inside.valueOr(inside.grid.indexAt(from + direction * radius), kOutside) != kOutside)
        radius += kRay_mm;
    return float(radius);
}

/// The part of `v` across a unit vector, as a unit vector.
Vector3 across(Vector3 v, Vector3 along)
{
    return normalized(v - along * dot(v, along));
}

}  // namespace

WallRelief reliefOf(const InsideView& inside, const Skeleton& skeleton, const Progress* wanted)
{
    WallRelief relief;
    if (skeleton.empty())
        return relief;
    const auto count = std::size_t(skeleton.length_mm()) + 1;
    relief.radius_mm.reserve(count);
    const Vector3 start = skeleton.tangentAt(0, kTangent_mm);
    Vector3 first = across(std::abs(start.y) < 0.9 ? Vector3{0, -1, 0} : Vector3{0, 0, 1}, start);
    for (std::size_t n = 0; n < count; ++n) {
        if (wanted)
            wanted->check();
        const Point3 middle = skeleton.at(double(n)).position_mm;
        const Vector3 along = skeleton.tangentAt(double(n), kTangent_mm);
        first = across(first, along);
        const Vector3 second = cross(along, first);
        auto& radii = relief.radius_mm.emplace_back();
        for (std::size_t d = 0; d < radii.size(); ++d) {
            const double angle = 2 * std::numbers::pi * double(d) / double(radii.size());
            radii[d] = radiusAlong(inside, middle, first * std::cos(angle) + second * std::sin(angle));
        }
    }
    return relief;
}

}  // namespace vicon

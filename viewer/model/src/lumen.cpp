#include "vicon/viewer/model/lumen.h"

#include <algorithm>

#include "vicon/core/error.h"
#include "vicon/core/nearest_voxel.h"

namespace vicon::viewer {

Lumen::Lumen(const InsideView& inside, const FieldView& wall_distance) : inside_(inside), wall_(wall_distance)
{
    if (inside.grid != wall_distance.grid)
        throw Error(ErrorCode::bad_input, "the inside voxels and the wall distance lie on different grids", {},
                    "run 'vicon work' to make them anew");
    const auto& s = inside.grid.spacing_mm;
    half_diagonal_mm_ = std::hypot(s[0], s[1], s[2]) / 2;
    step_mm_ = std::min({s[0], s[1], s[2]}) / 2;
}

bool Lumen::inside(Point3 p) const
{
    return inside_.valueOr(inside_.grid.indexAt(p), std::uint8_t(kOutside)) != kOutside;
}

double Lumen::clearance_mm(Point3 p) const
{
    const ContinuousIndex3 c = wall_.grid.continuousIndexAt(p);
    const Index3 v{int(std::floor(c.i)), int(std::floor(c.j)), int(std::floor(c.k))};
    const double a = c.i - v.i, b = c.j - v.j, d = c.k - v.k;
    const auto& size = wall_.grid.size;
    if (v.i >= 0 && v.j >= 0 && v.k >= 0 && v.i + 1 < size[0] && v.j + 1 < size[1] && v.k + 1 < size[2]) {
        const float* w = &wall_.at(v);
        const std::ptrdiff_t row = size[0], slice = row * size[1];
        const auto mixed = [&](const float* r) {
            const double front = r[0] + a * (r[1] - r[0]);
            const double back = r[row] + a * (r[row + 1] - r[row]);
            return front + b * (back - front);
        };
        const double low = mixed(w), high = mixed(w + slice);
        return low + d * (high - low);
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        const double weight = (i ? a : 1 - a) * (j ? b : 1 - b) * (k ? d : 1 - d);
        if (weight > 0)
            sum += weight * wallAt({v.i + i, v.j + j, v.k + k});
    }
    return sum;
}

Vector3 Lumen::clearanceGradient(Point3 p) const
{
    Vector3 gradient;
    for (int a = 0; a < 3; ++a) {
        const Vector3 axis = wall_.grid.axis[a];
        const double h = wall_.grid.spacing_mm[a];
        gradient += axis * ((clearance_mm(p + axis * h) - clearance_mm(p - axis * h)) / (2 * h));
    }
    return gradient;
}

bool Lumen::sees(Point3 from, Point3 to, double allowance_mm) const
{
    const double whole = distance(from, to);
    const double end = whole - allowance_mm;
    if (!inside(from))
        return false;
    const Vector3 direction = whole > 0 ? (to - from) / whole : Vector3{};
    double at = 0;
    while (at < end) {
        const Point3 p = from + direction * at;
        if (!inside(p))
            return false;
        // The field belongs to the voxel's middle, at most half a diagonal away; beyond that the ball is free of wall.
        at += std::max(step_mm_, freeBall_mm(p));
    }
    return end <= 0 || inside(from + direction * end);
}

Lumen::Nearest Lumen::nearestInside(Point3 p, double within_mm) const
{
    if (inside(p))
        return {true, p, 0};
    const auto nearest = nearestVoxel(inside_.grid, p, within_mm, [&](Index3 v) { return inside_.at(v) != kOutside; });
    if (!nearest)
        return {false, {}, within_mm};
    return {true, inside_.grid.pointAt(nearest->voxel), nearest->distance_mm};
}

}  // namespace vicon::viewer

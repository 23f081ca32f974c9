#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps::test {

/// A grid of `size` voxels centred on the origin of the patient's coordinates.
inline Grid centredGrid(std::array<int, 3> size, double spacing_mm)
{
    Grid grid;
    grid.size = size;
    grid.spacing_mm = {spacing_mm, spacing_mm, spacing_mm};
    grid.origin_mm = {-(size[0] - 1) * spacing_mm / 2, -(size[1] - 1) * spacing_mm / 2,
                      -(size[2] - 1) * spacing_mm / 2};
    return grid;
}

/// Signed distance to a tube around a polyline, negative inside; its ends are half balls.
inline double tubeDistance(const std::vector<Point3>& line, double radius_mm, Point3 p)
{
    double least = 1e300;
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
        const Vector3 ab = line[n + 1] - line[n];
        const double t = std::clamp(dot(p - line[n], ab) / std::max(1e-9, dot(ab, ab)), 0.0, 1.0);
        least = std::min(least, distance(p, line[n] + ab * t));
    }
    return least - radius_mm;
}

/// The share of a blurred edge's far side at a signed distance from it.
inline double blurred(double distance_mm, double sigma_mm)
{
    return 0.5 * (1 + std::erf(distance_mm / (sigma_mm * std::sqrt(2.0))));
}

/// A body (an elliptic cylinder of soft tissue in air) with a gas-filled tube, edges blurred by 0.7 mm; fluid of
/// `fluid_hu` fills what lies below `level_mm` along gravity where fluid_hu is above 0.
struct TubeScan {
    std::vector<Point3> line;
    double radius_mm = 12;
    Vector3 gravity{0, 1, 0};
    double level_mm = 1e9;
    double fluid_hu = 0;
    std::vector<Point3> second_line;  ///< another tube of the same radius; empty: none

    double signedDistance(Point3 p) const
    {
        const double a = tubeDistance(line, radius_mm, p);
        return second_line.empty() ? a : std::min(a, tubeDistance(second_line, radius_mm, p));
    }

    HuVolume draw(const Grid& grid) const
    {
        constexpr double kSigma_mm = 0.7;
        HuVolume volume(grid, kPaddingHu);
        const Point3 last = grid.pointAt(Index3{grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1});
        const double rx = last.x - 8, ry = last.y - 8;
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            const double body_mm = (1 - std::hypot(p.x / rx, p.y / ry)) * std::min(rx, ry);
            double hu = -1000 + 1040 * blurred(body_mm, kSigma_mm);
            const double d = signedDistance(p);
            if (d < 5) {
                const double below = blurred(dot(p - Point3{}, gravity) - level_mm, kSigma_mm);
                const double content = fluid_hu > 0 ? -1000 + (fluid_hu + 1000) * below : -1000;
                hu = content + (40 - content) * blurred(d, kSigma_mm);
            }
            volume.voxels[n] = std::int16_t(std::lround(hu));
        }
        return volume;
    }
};

inline InsideVolume drawMask(const Grid& grid, const std::function<bool(Point3)>& inside)
{
    InsideVolume mask(grid);
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        mask.voxels[n] = inside(grid.pointAt(grid.indexOf(n))) ? kGas : kOutside;
    return mask;
}

/// Of what was found and what was drawn, on the voxels of `grid`.
inline double dice(const InsideVolume& found, const Grid& grid, const TubeScan& scan)
{
    double both = 0, truth = 0, own = 0;
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Point3 p = grid.pointAt(grid.indexOf(n));
        const bool a = scan.signedDistance(p) < 0;
        const bool b = found.valueOr(found.grid.indexAt(p), kOutside) != kOutside;
        truth += a;
        own += b;
        both += a && b;
    }
    return 2 * both / (truth + own);
}

}  // namespace vicon::steps::test

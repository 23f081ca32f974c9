// The distance from boundary against the surface that is drawn: both say where the wall lies between two voxels.
#include <gtest/gtest.h>

#include <vtkNew.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "vicon/steps/cells.h"
#include "vicon/steps/wall_distance.h"
#include "vicon/support/poly_data.h"

namespace vicon::steps {
namespace {

NoProgress quiet;

/// A bent tube of gas with folds, blurred.
struct Tube {
    HuVolume hu;
    InsideVolume inside;
};

Tube bentTube(Vector3 shift)
{
    const Grid grid{.size = {70, 66, 44}, .origin_mm = {4, -9, 2}, .spacing_mm = {0.7, 0.7, 0.7}};
    Tube tube{HuVolume(grid), InsideVolume(grid)};
    const Point3 centre = grid.pointAt(ContinuousIndex3{34.5, 32.5, 21.5}) + shift;
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Vector3 d = grid.pointAt(grid.indexOf(n)) - centre;
        const double angle = std::atan2(d.y, d.x), from_axis = std::hypot(d.x, d.y) - 14;
        const double radius_mm = 6.5 + 0.8 * std::cos(7 * angle);
        const double wall = 0.5 * std::erfc(-(std::hypot(from_axis, d.z) - radius_mm) / (std::sqrt(2.0) * 0.6));
        tube.hu.voxels[n] = std::int16_t(std::lround(-1000 + 1040 * wall));
        tube.inside.voxels[n] = tube.hu.voxels[n] < -480 ? kGas : kOutside;
    }
    return tube;
}

struct Errors {
    double mean_mm = 0, worst_mm = 0;
};

Errors errorsOf(const FieldVolume& field, const InsideVolume& inside, vtkStaticCellLocator& surface)
{
    Errors errors;
    int count = 0;
    for (std::size_t n = 0; n < field.voxels.size(); n += 7) {
        if (!inside.voxels[n])
            continue;
        const Point3 p = field.grid.pointAt(field.grid.indexOf(n));
        const double at[3] = {p.x, p.y, p.z};
        double foot[3], square = 0;
        vtkIdType triangle = 0;
        int part = 0;
        surface.FindClosestPoint(at, foot, triangle, part, square);
        const double error_mm = std::abs(field.voxels[n] - std::sqrt(square));
        errors.worst_mm = std::max(errors.worst_mm, error_mm);
        errors.mean_mm += error_mm;
        ++count;
    }
    errors.mean_mm /= count;
    return errors;
}

TEST(WallDistance, IsThatOfTheSurfaceDrawnToAFractionOfAVoxel)
{
    constexpr double kVoxel_mm = 0.7;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(0, kVoxel_mm);
    for (int n = 0; n < 4; ++n) {
        const Tube tube = bentTube({part(random), part(random), part(random)});
        SegmentVolume segments(tube.inside.grid);
        std::transform(tube.inside.voxels.begin(), tube.inside.voxels.end(), segments.voxels.begin(),
                       [](std::uint8_t v) { return std::uint16_t(v ? 1 : 0); });
        const LumenSurface surface(tube.hu, tube.inside, {}, quiet);
        const auto drawn = support::asPolyData(surface.cellsOf(segments, quiet));
        vtkNew<vtkStaticCellLocator> locator;
        locator->SetDataSet(drawn);
        locator->BuildLocator();
        const Errors fine = errorsOf(wallDistance(tube.inside, surface.nearWall(), quiet), tube.inside, *locator);
        const Errors coarse = errorsOf(wallDistance(tube.inside, quiet), tube.inside, *locator);
        EXPECT_LT(fine.mean_mm, 0.06 * kVoxel_mm);
        EXPECT_LT(fine.worst_mm, 0.5 * kVoxel_mm);
        EXPECT_LT(fine.mean_mm, 0.3 * coarse.mean_mm);
    }
}

}  // namespace
}  // namespace vicon::steps

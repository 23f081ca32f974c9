// Folds thinner than the blur under tagged fluid, and what must not be taken for one.
#include <gtest/gtest.h>

#include "segment_shapes.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {
namespace {

using test::blurred;
using test::centredGrid;
using test::TubeScan;

/// A small colon, its lower part full of fluid, with a fold of a bell-shaped profile across the tube at x = 45: on its
/// left half, where nothing of it gets as dark as half-way between tissue and fluid.
struct FoldScan {
    static constexpr double kSigma_mm = 1, kTip_mm = 44, kTissue_hu = 40;
    TubeScan tube{.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {-45, 0, 45}, {-45, 0, -40}}};
    Grid grid = centredGrid({188, 113, 206}, 0.8);
    HuVolume volume;
    InsideVolume inside;

    explicit FoldScan(double dark)
    {
        tube.fluid_hu = 800;
        tube.level_mm = -1.7;
        volume = tube.draw(grid);
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            const double profile = std::exp(-p.z * p.z / (2 * kSigma_mm * kSigma_mm)) * blurred(p.x - kTip_mm, 0.7) *
                                   blurred(p.y - 1, 0.7);
            if (tube.signedDistance(p) < 2 && volume.voxels[n] > kTissue_hu)
                volume.voxels[n] = std::int16_t(volume.voxels[n] - dark * profile * (volume.voxels[n] - kTissue_hu));
        }
        NoProgress progress;
        inside = segmentColon(volume, tube.gravity, {}, progress).inside;
    }

    bool isInside(Point3 p) const { return inside.valueOr(inside.grid.indexAt(p), kOutside) != kOutside; }
    /// Within the fluid, away from its level and from the tube's wall.
    bool deep(Point3 p) const { return p.y > 5 && tube.signedDistance(p) < -2 && std::abs(p.x - 45) < 14; }
};

/// Share of the voxels of the fold's middle that are outside.
double shareKept(const FoldScan& scan)
{
    int kept = 0, all = 0;
    for (std::size_t n = 0; n < scan.grid.voxelCount(); ++n) {
        const Point3 p = scan.grid.pointAt(scan.grid.indexOf(n));
        if (!scan.deep(p) || std::abs(p.z) > 0.5 || p.x < FoldScan::kTip_mm + 2)
            continue;
        ++all;
        kept += scan.isInside(p) ? 0 : 1;
    }
    return all > 20 ? double(kept) / all : -1;
}

TEST(ThinFolds, AreWholeWhereBlurLiftsThemAboveHalfWay)
{
    EXPECT_GT(shareKept(FoldScan(0.45)), 0.98);
}

TEST(ThinFolds, LeaveTheFluidBesideThem)
{
    const FoldScan scan(0.45);
    for (std::size_t n = 0; n < scan.grid.voxelCount(); ++n) {
        const Point3 p = scan.grid.pointAt(scan.grid.indexOf(n));
        if (scan.deep(p) && (std::abs(p.z) > 2.4 || p.x < FoldScan::kTip_mm - 2.4)) {
            ASSERT_TRUE(scan.isInside(p)) << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(ThinFolds, HaveTheirSurfaceHalfWayBetweenTheirBottomAndTheFluid)
{
    const FoldScan scan(0.45);
    SegmentVolume segments(scan.inside.grid);
    std::transform(scan.inside.voxels.begin(), scan.inside.voxels.end(), segments.voxels.begin(),
                   [](std::uint8_t label) { return std::uint16_t(label != kOutside); });
    NoProgress progress;
    const CellSurface surface = extractCells(scan.volume, scan.inside, segments, {}, progress);
    const double half_mm = FoldScan::kSigma_mm * std::sqrt(2 * std::log(2.0));
    std::vector<double> errors_mm;
    for (std::size_t n = 0; n < surface.pointCount(); ++n) {
        const Point3 p = surface.point(n);
        // Three millimetres from the wall and from the tip: there the bottom is as dark as it is drawn.
        if (scan.deep(p) && scan.tube.signedDistance(p) < -3 && std::abs(p.z) < 4 && p.x > FoldScan::kTip_mm + 3)
            errors_mm.push_back(std::abs(std::abs(p.z) - half_mm));
    }
    ASSERT_GT(errors_mm.size(), 30U);
    std::sort(errors_mm.begin(), errors_mm.end());
    EXPECT_LT(errors_mm[errors_mm.size() / 2], 0.25) << errors_mm.back();
    EXPECT_LT(errors_mm[errors_mm.size() * 95 / 100], 0.5);
}

TEST(ThinFolds, AreNotMadeOfAFaintStreak)
{
    EXPECT_EQ(shareKept(FoldScan(0.2)), 0);
}

}  // namespace
}  // namespace vicon::steps

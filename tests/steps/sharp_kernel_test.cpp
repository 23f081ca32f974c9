// Kernels that make edges overshoot: known by the rims of walls, and softened to what a usual kernel makes.
#include "grid/sharp_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "vicon/core/progress.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {
namespace {

constexpr double kVoxel_mm = 0.75, kRadius_mm = 25, kTissue_hu = 40;
constexpr int kEdge = 96, kSlices = 220;

/// The part of an edge's step at so many millimetres behind it.
double blurred(double mm, double sigma_mm)
{
    return 0.5 * std::erfc(-mm / (sigma_mm * std::sqrt(2.0)));
}
double usual(double mm)
{
    return blurred(mm, 0.7);
}
/// What a blur of twice the width takes away, added one and a half times: an edge's fifth overshoots.
double sharp(double mm)
{
    return 2.5 * blurred(mm, 0.55) - 1.5 * blurred(mm, 1.1);
}

Grid grid()
{
    Grid grid;
    grid.size = {kEdge, kEdge, kSlices};
    grid.spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm};
    return grid;
}

double behindWall_mm(int i, int j)
{
    return std::hypot(i - kEdge / 2, j - kEdge / 2) * kVoxel_mm - kRadius_mm;
}

/// A tube along the slices through tissue.
HuVolume tube(double inside_hu, const std::function<double(double)>& edge)
{
    HuVolume hu(grid());
    for (int k = 0; k < kSlices; ++k)
        for (int j = 0; j < kEdge; ++j)
            for (int i = 0; i < kEdge; ++i)
                hu.at({i, j, k}) =
                    std::int16_t(std::lround(inside_hu + (kTissue_hu - inside_hu) * edge(behindWall_mm(i, j))));
    return hu;
}

TEST(SharpKernel, OfUsualEdgesNothingIsSoftened)
{
    const HuVolume hu = tube(-1000, usual);
    EXPECT_LT(edgeOvershoot_hu(hu, {}).value(), 20);
    EXPECT_FALSE(softened(hu, {}));
}

TEST(SharpKernel, TaggingIsNoOvershoot)
{
    EXPECT_FALSE(edgeOvershoot_hu(tube(500, usual), {}));
    EXPECT_FALSE(softened(tube(500, sharp), {})) << "no gas tells";
}

TEST(SharpKernel, OvershootIsMeasuredAndSoftenedInPlace)
{
    HuVolume hu = tube(-1000, sharp);
    hu.at({3, 3, 3}) = kPaddingHu;
    const auto soft = softened(hu, {});
    ASSERT_TRUE(soft);
    EXPECT_GT(soft->overshoot_hu, 90);
    EXPECT_LT(soft->overshoot_hu, 200);
    EXPECT_EQ(soft->hu.at({3, 3, 3}), kPaddingHu);
    const int k = kSlices / 2, j = kEdge / 2;
    double half_mm = 0;
    for (int i = j; i < kEdge; ++i) {
        const double mm = behindWall_mm(i, j), softer_hu = soft->hu.at({i, j, k});
        EXPECT_LT(softer_hu, kTissue_hu + 65) << mm << " mm behind the wall";
        if (mm > 6) {
            EXPECT_NEAR(softer_hu, kTissue_hu, 3) << mm;
        }
        const double before_hu = soft->hu.at({i - 1, j, k});
        if (before_hu < -480 && softer_hu >= -480)
            half_mm = mm - kVoxel_mm * (softer_hu + 480) / (softer_hu - before_hu);
    }
    EXPECT_NEAR(half_mm, 0, 0.1) << "the wall stays where it is";
}

TEST(SharpKernel, CleansedSlicesShowWhatWasAcquired)
{
    const HuVolume hu = tube(-1000, sharp);
    InsideVolume labels(grid());
    for (int k = 8; k < kSlices - 8; ++k)
        for (int j = 0; j < kEdge; ++j)
            for (int i = 0; i < kEdge; ++i)
                if (behindWall_mm(i, j) < 0)
                    labels.at({i, j, k}) = kGas;
    NoProgress quiet;
    EXPECT_EQ(findTissue(hu, labels, {0, 1, 0}, {}, 10, quiet).cleansed.voxels, hu.voxels);
}

}  // namespace
}  // namespace vicon::steps

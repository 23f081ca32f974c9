// Bowel that lies so close under the skin that the wall of the body over it is thinner than what removes the table.

#include <gtest/gtest.h>

#include "segment_shapes.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {
namespace {

using test::centredGrid;
using test::TubeScan;

/// Up on the left, across in the middle of the body, down on the right.
TubeScan colon()
{
    return {.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {-45, 0, 45}, {-45, 0, -40}}};
}

/// Wide enough that the body's skin is so far from the colon's lumen at its sides.
Grid gridWithWall(double wall_mm)
{
    constexpr double kSpacing_mm = 1.5, kSides_mm = 2 * (45 + 12), kAir_mm = 2 * 8;
    return centredGrid({int(std::lround((kSides_mm + kAir_mm + 2 * wall_mm) / kSpacing_mm)) + 1, 80, 120}, kSpacing_mm);
}

Segmentation segment(const HuVolume& volume)
{
    NoProgress progress;
    return segmentColon(volume, {0, 1, 0}, {}, progress);
}

class BodyWall : public testing::TestWithParam<double> {};

TEST_P(BodyWall, ThinOverBowelIsNotTakenForTheTable)
{
    const Grid grid = gridWithWall(GetParam());
    const TubeScan scan = colon();
    const Segmentation result = segment(scan.draw(grid));
    EXPECT_EQ(result.plan.pieces.size(), 1U);
    EXPECT_GE(dice(result.inside, grid, scan), 0.97);
}

INSTANTIATE_TEST_SUITE_P(Thickness_mm, BodyWall, testing::Values(4.5, 6, 7.5, 9));

TEST(BodyWall, AirUnderABlanketIsNoBowel)
{
    constexpr double kHalf_mm = 24, kHeight_mm = 18, kBlanket_mm = 4.5;  // thin enough to be taken for the table
    const Grid body = centredGrid({110, 80, 120}, 1.5);
    const HuVolume drawn = colon().draw(body);
    HuVolume volume(centredGrid({110, 120, 120}, 1.5), -1000);
    const double front_mm = body.origin_mm.y + 8;  // of the skin
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        const Point3 p = volume.grid.pointAt(volume.grid.indexOf(n));
        std::int16_t& hu = volume.voxels[n];
        hu = drawn.valueOr(body.indexAt(p), -1000);
        const double out_mm =
            std::max({std::abs(p.x) - kHalf_mm, std::abs(p.z) - kHalf_mm, front_mm - kHeight_mm - p.y});
        if (p.y < front_mm + kHeight_mm && out_mm > 0 && out_mm < kBlanket_mm)
            hu = std::max<std::int16_t>(hu, 0);
    }
    const Segmentation result = segment(volume);
    EXPECT_EQ(result.measures["candidates"].size(), 1U) << result.measures["candidates"];
}

}  // namespace
}  // namespace vicon::steps

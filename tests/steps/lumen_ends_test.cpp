// The ends of a lumen whose loops are joined through a hole: they are the colon's own, never the middle of a loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "loop_shapes.h"
#include "vicon/steps/lumen_plan.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {
namespace {

using test::blurred;
using test::centredGrid;
using test::joinedBy;
using test::Limbs;
using test::Loops;
using test::Polyline;
using test::tubeDistance;
using test::TubeScan;
using test::Window;

/// How far the ends found lie from the true tips, the worse of the two.
double endsOff_mm(const Loops& loops, const LumenPiece& piece)
{
    const Polyline line = loops.limbs.line();
    const Point3 one = loops.turned(line.front()), other = loops.turned(line.back());
    const auto off = [&](Point3 a, Point3 b) {
        return std::max(distance(piece.rectal_end_mm, a), distance(piece.caecal_end_mm, b));
    };
    return std::min(off(one, other), off(other, one));
}

void expectEndsFound(const Loops& loops)
{
    const InsideVolume mask = loops.draw();
    const LumenPlan plan = planForMask(mask);
    ASSERT_EQ(plan.pieces.size(), 1U);
    EXPECT_LT(endsOff_mm(loops, plan.pieces[0]), loops.limbs.radius_mm + 4);
    NoProgress quiet;
    EXPECT_NEAR(findSkeleton(mask, plan, {}, quiet).curve.length_mm(), loops.limbs.length_mm(), 5);
}

struct Case {
    Limbs limbs;
    std::vector<Window> windows;
};

class EndsOfLoops : public testing::TestWithParam<Case> {};

TEST_P(EndsOfLoops, LieAtTheTips)
{
    expectEndsFound(joinedBy(GetParam().windows, GetParam().limbs));
}

INSTANTIATE_TEST_SUITE_P(Holes, EndsOfLoops,
                         testing::Values(Case{{.radius_mm = 6.5}, {{.wide_mm = 5.5}}},
                                         Case{{.radius_mm = 8}, {{.wide_mm = 8}}},
                                         Case{{.radius_mm = 10}, {{.wide_mm = 8, .z_mm = 100}}},
                                         Case{{.radius_mm = 15}, {{.wide_mm = 16}}},
                                         Case{{.radius_mm = 8, .count = 3}, {{8, 30, 0}, {8, 370, 1}}},
                                         Case{{.radius_mm = 8, .long_mm = 200, .count = 4}, {{8, 30, 0}}},
                                         Case{{.radius_mm = 8, .long_mm = 200, .count = 4}, {{8, 30, 2}}},
                                         Case{{.radius_mm = 8, .long_mm = 200, .count = 3}, {{8, 195, 1}}}));

TEST(LumenEnds, AreFoundThoughTheHoleIsLong)
{
    for (const double wide_mm : {8.0, 12.0}) {
        const Loops loops = joinedBy({{.wide_mm = wide_mm, .z_mm = 60, .longer_mm = 40}}, {.radius_mm = 10});
        const LumenPlan plan = planForMask(loops.draw());
        ASSERT_EQ(plan.pieces.size(), 1U);
        EXPECT_LT(endsOff_mm(loops, plan.pieces[0]), loops.limbs.radius_mm + 4) << wide_mm;
    }
}

TEST(LumenEnds, AreFoundThoughAStrictureOrAFoldLiesBesideAPouch)
{
    for (const Loops& loops : {test::strictureBesideAPouch(), test::pouchPastAFold(6)})
        expectEndsFound(loops);
}

const Grid kGrid = centredGrid({110, 80, 120}, 1.5);

/// The scan with a hole from one place to another, as wide as a tube of 6 mm.
HuVolume withHole(const TubeScan& scan, Point3 from, Point3 to)
{
    HuVolume volume = scan.draw(kGrid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        const double outside = blurred(tubeDistance({from, to}, 6, kGrid.pointAt(kGrid.indexOf(n))), 0.7);
        volume.voxels[n] = std::min(volume.voxels[n], std::int16_t(std::lround(-1000 + 1040 * outside)));
    }
    return volume;
}

TEST(LumenEnds, ALoopThatTouchesTheRectosigmoidIsNoCaecum)
{
    // The ascending colon lies beside the sigmoid; they are joined half-way down to the caecum.
    const TubeScan scan{.line = {{-20, 5, -70}, {-20, 5, -10}, {44, 5, -10}, {44, 5, 60}, {-44, 5, 60}, {-44, 5, -60}},
                        .radius_mm = 10};
    NoProgress quiet;
    const Segmentation found = segmentColon(withHole(scan, {-20, 5, -25}, {-44, 5, -25}), scan.gravity, {}, quiet);
    ASSERT_EQ(found.plan.pieces.size(), 1U);
    EXPECT_LT(distance(found.plan.pieces[0].rectal_end_mm, scan.line.front()), 16);
    EXPECT_LT(distance(found.plan.pieces[0].caecal_end_mm, scan.line.back()), 16);
    EXPECT_GT(found.plan.pieces[0].length_mm, 380);
}

TEST(LumenEnds, TwoPiecesThatTouchAreStillTwo)
{
    const TubeScan scan{.line = {{-20, 5, -70}, {-20, 5, 28}, {44, 5, 28}, {44, 5, 62}},
                        .radius_mm = 10,
                        .second_line = {{5, 5, 62}, {-44, 5, 62}, {-44, 5, -65}}};
    NoProgress quiet;
    const Segmentation found = segmentColon(withHole(scan, {-20, 5, 0}, {-44, 5, 0}), scan.gravity, {}, quiet);
    ASSERT_EQ(found.plan.pieces.size(), 2U) << found.reason;
    EXPECT_LT(distance(found.plan.pieces[0].rectal_end_mm, scan.line.front()), 16);
    EXPECT_LT(distance(found.plan.pieces[0].caecal_end_mm, scan.line.back()), 16);
    EXPECT_LT(distance(found.plan.pieces[1].rectal_end_mm, scan.second_line.front()), 16);
    EXPECT_LT(distance(found.plan.pieces[1].caecal_end_mm, scan.second_line.back()), 16);
}

TEST(LumenEnds, ABranchIsNoPieceOfItsOwn)
{
    // It begins where the colon is joined to it, as ileum does.
    const TubeScan scan{.line = {{-20, 5, -70}, {-20, 5, 28}, {44, 5, 28}, {44, 5, 62}, {-20, 11, 62}},
                        .second_line = {{-44, 5, 0}, {-44, 5, -65}}};
    NoProgress quiet;
    const Segmentation found = segmentColon(withHole(scan, {-20, 5, 0}, {-44, 5, 0}), scan.gravity, {}, quiet);
    EXPECT_EQ(found.plan.pieces.size(), 1U) << found.reason;
}

}  // namespace
}  // namespace vicon::steps

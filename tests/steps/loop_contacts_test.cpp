// Loops of the colon that are joined through a hole in the wall between them: the centreline goes around each of them,
// and a narrow place that is the only way, or a pouch with two mouths, is no such hole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "loop_shapes.h"
#include "skeleton_phantom.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {
namespace {

using test::joinedBy;
using test::Loops;
using test::Polyline;
using test::tubeDistance;

SkeletonResult centrelineOf(const Loops& loops)
{
    const Polyline line = loops.limbs.line();
    const Vector3 to_tip{0, 0, loops.limbs.radius_mm - 2};
    LumenPlan plan;
    plan.pieces.push_back({loops.turned(line.front() - to_tip),
                           loops.turned(loops.limbs.count % 2 == 0 ? line.back() - to_tip : line.back() + to_tip)});
    NoProgress quiet;
    return findSkeleton(loops.draw(), plan, {}, quiet);
}

void expectFollowed(const Loops& loops)
{
    const SkeletonResult found = centrelineOf(loops);
    const Polyline line = loops.limbs.line();
    EXPECT_NEAR(found.curve.length_mm(), loops.limbs.length_mm(), 5);
    double aside_mm = 0;
    for (const SkeletonPiece& piece : found.curve.pieces)
        for (const SkeletonPoint& p : piece.points)
            aside_mm = std::max(aside_mm, tubeDistance(line, 0, loops.turned(p.position_mm)));
    EXPECT_LT(aside_mm, 2);
}

struct Hole {
    double radius_mm, wide_mm;
};

class LoopsWithAHole : public testing::TestWithParam<Hole> {};

TEST_P(LoopsWithAHole, AreFollowedAround)
{
    expectFollowed(joinedBy({{.wide_mm = GetParam().wide_mm}}, {.radius_mm = GetParam().radius_mm}));
}

INSTANTIATE_TEST_SUITE_P(Widths, LoopsWithAHole,
                         testing::Values(Hole{6.5, 3}, Hole{6.5, 5}, Hole{6.5, 5.5}, Hole{6.5, 6}, Hole{6.5, 8},
                                         Hole{6.5, 10}, Hole{8, 6}, Hole{8, 10}, Hole{10, 5.5}, Hole{10, 8},
                                         Hole{10, 12}, Hole{15, 8}, Hole{15, 16}, Hole{15, 20}));

TEST(LoopContacts, AreNoWayWhateverVoxelsTheyFallOn)
{
    for (const double z_mm : {30.0, 30.5}) {
        Loops loops = joinedBy({{.wide_mm = 6, .z_mm = z_mm}});
        loops.voxel_mm = 0.75;
        expectFollowed(loops);
    }
}

TEST(LoopContacts, NearABendAreNoWay)
{
    for (const double from_bend_mm : {40.0, 70.0, 100.0})
        for (const double wide_mm : {5.5, 8.0})
            expectFollowed(joinedBy({{.wide_mm = wide_mm, .z_mm = 400 - from_bend_mm}}));
}

TEST(LoopContacts, LeaveNoWallThatPassesForARectalTube)
{
    // The wall between hole and bend has lumen all around it in a slice.
    for (const double from_bend_mm : {50.0, 70.0, 100.0})
        for (const double wide_mm : {5.5, 8.0}) {
            Loops loops = joinedBy({{.wide_mm = wide_mm, .z_mm = 400 - from_bend_mm}});
            loops.lying = true;
            expectFollowed(loops);
        }
}

TEST(LoopContacts, BesideTheEndsAreNoWay)
{
    for (const double wide_mm : {5.5, 8.0})
        expectFollowed(joinedBy({{.wide_mm = wide_mm, .z_mm = 0}}));
}

TEST(LoopContacts, AreNoWayWhereThereAreSeveral)
{
    for (const double wide_mm : {5.5, 8.0}) {
        expectFollowed(joinedBy({{wide_mm, 30}, {wide_mm, 60}}));
        expectFollowed(joinedBy({{wide_mm, 30, 0}, {wide_mm, 370, 1}}, {.count = 3}));
        expectFollowed(joinedBy({{wide_mm, 200, 0}, {wide_mm, 200, 1}}, {.count = 3}));
    }
}

TEST(LoopContacts, AreNoWayWhereTheyAreLong)
{
    expectFollowed(joinedBy({{.wide_mm = 5.5, .z_mm = 40, .longer_mm = 20}}));
    expectFollowed(joinedBy({{.wide_mm = 8, .z_mm = 40, .longer_mm = 10}}));
}

TEST(LoopContacts, AreNoWayWhereFoldsOrASpasmAreNarrower)
{
    Loops folded = joinedBy({{.wide_mm = 8, .z_mm = 40}});
    folded.narrowed = [limbs = folded.limbs](Point3 p) {
        const bool in_fold = std::abs(std::remainder(p.z - 5, 25)) < 1.5 && p.z < 395;
        return in_fold && limbs.fromMiddle(p) > 0.55 * limbs.radius_mm;
    };
    expectFollowed(folded);
    Loops spastic = joinedBy({{.wide_mm = 8}});
    spastic.narrowed = [limbs = spastic.limbs](Point3 p) {
        return std::abs(p.z - 200) < 10 && p.y < limbs.radius_mm && limbs.fromMiddle(p) > 2;
    };
    expectFollowed(spastic);
}

TEST(LoopContacts, AStrictureIsNoneThoughAPouchHangsOnBesideIt)
{
    expectFollowed(test::strictureBesideAPouch());
}

TEST(LoopContacts, APouchWithTwoMouthsBesideAFoldIsNoWay)
{
    for (const double mouth_mm : {4.0, 6.0, 8.0})
        expectFollowed(test::pouchPastAFold(mouth_mm));
}

TEST(LoopContacts, OfPhantomsThatRunIntoThemselvesAreNoWay)
{
    NoProgress quiet;
    for (const std::uint64_t seed : {21U, 23U}) {
        phantom::PhantomOptions options;
        options.seed = seed;
        options.size = {256, 256, 288};
        options.spacing_mm = {1.5, 1.5, 1.5};
        options.gaps = 0;
        options.self_contact = true;
        const auto truth = phantom::makeScan(options, "HFS", quiet).truth;
        LumenPlan plan;
        plan.pieces.push_back({truth.curve.front().position_mm, truth.curve.back().position_mm});
        const auto errors = test::curveErrors(findSkeleton(truth.inside, plan, {}, quiet).curve, truth);
        EXPECT_LT(std::abs(errors.length_fraction), 0.02) << "seed " << seed;
        EXPECT_LT(errors.most_mm, 2) << "seed " << seed;
    }
}

}  // namespace
}  // namespace vicon::steps

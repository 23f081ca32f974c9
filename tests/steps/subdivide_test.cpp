#include "vicon/steps/subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "subdivision_checks.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

TEST(Subdivide, IsAPartitionIntoConnectedSegmentsWithEnclosingGates)
{
    for (const Lumen& lumen : {bentTube(), bridgedTubes()}) {
        const Subdivided divided = divide(lumen);
        expectPartition(lumen, divided);
        expectGatesEnclose(divided);
    }
}

TEST(Subdivide, CutsAStraightTubeIntoEqualPiecesWithFlatPortals)
{
    const Grid grid{.size = {28, 28, 130}};
    const Skeleton skeleton{{pieceThrough({{14, 14, 5}, {14, 14, 125}}, 10)}};
    const Lumen lumen{
        maskOf(grid, [](Point3 p) { return std::hypot(p.x - 14, p.y - 14) < 10 && p.z > 4.5 && p.z < 124.5; }),
        skeleton};
    const Subdivided divided = divide(lumen);
    ASSERT_EQ(divided.description.segments.size(), 4U);
    ASSERT_EQ(divided.description.portals.size(), 3U);
    for (const auto& segment : divided.description.segments)
        EXPECT_NEAR(segment.volume_mm3, M_PI * 100 * 30, 0.06 * M_PI * 100 * 30);
    for (std::size_t n = 0; n < 3; ++n) {
        const auto& portal = divided.description.portals[n];
        EXPECT_TRUE(portal.along_skeleton);
        EXPECT_NEAR(portal.normal.z, 1, 1e-6);
        EXPECT_NEAR(portal.centre_mm.z, 35 + 30 * double(n), 1.01);
        EXPECT_NEAR(portal.area_mm2, M_PI * 100, 0.03 * M_PI * 100);
        EXPECT_NEAR(distance(portal.box_mm[0], portal.box_mm[4]), 2 * std::sqrt(3.0), 1.01);
    }
}

TEST(Subdivide, TakesTheSpecifiedNumberOfSegments)
{
    for (const int segments : {3, 7, 12})
        EXPECT_EQ(divide(bentTube(), {.segments = segments}).description.segments.size(), std::size_t(segments));
}

TEST(Subdivide, NoSegmentSpansABridge)
{
    const Lumen lumen = bridgedTubes();
    const Subdivided divided = divide(lumen, {.length_mm = 200});
    ASSERT_EQ(divided.description.segments.size(), 2U);
    EXPECT_EQ(divided.segments.at({20, 15, 15}), 1);
    EXPECT_EQ(divided.segments.at({100, 15, 15}), 2);
    EXPECT_TRUE(divided.description.portals.empty());
}

TEST(Subdivide, NumbersRunFromTheRectum)
{
    const Lumen lumen = bentTube();
    const Subdivided divided = divide(lumen);
    int before = 0;
    for (double s = 0; s < lumen.skeleton.length_mm(); s += 1) {
        const int here = divided.segments.at(lumen.inside.grid.indexAt(lumen.skeleton.at(s).position_mm));
        EXPECT_GE(here, before);
        before = here;
    }
    EXPECT_EQ(before, int(divided.description.segments.size()));
}

TEST(Subdivide, AContactIsAnEdgeOfTheGraphThatDoesNotFollowTheSkeleton)
{
    Lumen lumen = bentTube();
    for (int j = 15; j < 52; ++j)
        for (int i = 38; i < 44; ++i)
            lumen.inside.at({i, j, 19}) = kGas;  // a hole between the two limbs
    const Subdivided divided = divide(lumen);
    expectPartition(lumen, divided);
    expectGatesEnclose(divided);
    const auto& portals = divided.description.portals;
    const auto contact = std::find_if(portals.begin(), portals.end(), [](const auto& p) { return !p.along_skeleton; });
    ASSERT_NE(contact, portals.end());
    EXPECT_GT(contact->segment_b - contact->segment_a, 2);
    EXPECT_GT(std::abs(contact->normal.y), 0.9);
    EXPECT_NEAR(contact->centre_mm.x, 41, 4);
}

TEST(Subdivide, WhatNothingJoinsToTheSkeletonHasASegmentOfItsOwn)
{
    Lumen lumen = bentTube();
    lumen.inside.at({0, 0, 0}) = kGas;
    lumen.inside.at({100, 68, 38}) = lumen.inside.at({101, 69, 39}) = kFluid;
    const Subdivided divided = divide(lumen);
    expectPartition(lumen, divided);
    EXPECT_EQ(divided.segments.at({100, 68, 38}), divided.segments.at({101, 69, 39}));
    EXPECT_EQ(divided.description.segments.size(), divide(bentTube()).description.segments.size() + 2);
}

TEST(Subdivide, HoldsOnRealColons)
{
    VICON_NEEDS_DATA("shapes/EdinGCA_3D_00060.mha");
    const Lumen lumen = realColon("EdinGCA_3D_00060");
    const Subdivided divided = divide(lumen);
    expectPartition(lumen, divided);
    expectGatesEnclose(divided);
    EXPECT_NEAR(double(divided.description.segments.size()), lumen.skeleton.length_mm() / 30, 5);
}

/// Voxels of each piece's path, as the skeleton step knows them before there is a curve.
std::vector<std::vector<Index3>> voxelPathsOf(const Lumen& lumen)
{
    std::vector<std::vector<Index3>> paths;
    for (const auto& points : voxelsAlong(lumen.skeleton, lumen.inside)) {
        std::vector<Index3>& path = paths.emplace_back();
        for (const Point3 p : points)
            path.push_back(lumen.inside.grid.indexAt(p));
    }
    return paths;
}

TEST(Subdivide, AFloodMadeAheadChangesNothingWhicheverPathsItIsOf)
{
    NoProgress quiet;
    for (Lumen lumen : {bentTube(), bridgedTubes()}) {
        lumen.inside.at({2, 2, 2}) = lumen.inside.at({3, 3, 3}) = kFluid;  // that no path reaches
        const Subdivided plain = divide(lumen);
        std::vector<std::vector<Index3>> others = voxelPathsOf(lumen);
        others.front().resize(5);
        for (const auto& paths : {voxelPathsOf(lumen), others}) {
            const Subdivided divided =
                subdivide(lumen.inside, lumen.skeleton, voxelsAlong(lumen.skeleton, lumen.inside), {}, quiet,
                          floodFromPaths(lumen.inside, paths));
            EXPECT_EQ(divided.segments.voxels, plain.segments.voxels);
            EXPECT_EQ(divided.description.segments.size(), plain.description.segments.size());
        }
    }
}

TEST(Subdivide, RefusesAnEmptySkeleton)
{
    NoProgress quiet;
    EXPECT_THROW(subdivide(bentTube().inside, {}, {}, {}, quiet), Error);
}

}  // namespace
}  // namespace vicon::steps

#include "vicon/viewer/model/unseen.h"

#include <gtest/gtest.h>

#include <set>

#include "test_colon.h"
#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

struct Unseen : testing::Test {
    test::TestColon colon;
    PathFrames path{colon.skeleton};
    Lumen lumen{colon.inside, colon.wall_distance};
    Coverage coverage{triangleAreas_mm2(colon.cells.points_mm, colon.cells.triangles)};

    Point3 middleOf(std::size_t triangle) const
    {
        Vector3 sum;
        for (std::size_t n = 0; n < 3; ++n)
            sum += colon.cells.point(colon.cells.triangles[3 * triangle + n]) - Point3{};
        return Point3{} + sum / 3;
    }
    // All but the triangles within a radius of the places are seen.
    void seeAllBut(const std::vector<Point3>& places, double radius_mm)
    {
        std::vector<std::uint32_t> seen;
        for (std::uint32_t t = 0; t < colon.cells.triangleCount(); ++t) {
            const bool hidden = std::any_of(places.begin(), places.end(),
                                            [&](Point3 p) { return distance(middleOf(t), p) < radius_mm; });
            if (!hidden)
                seen.push_back(t);
        }
        coverage.see(seen);
    }
    // The point of the surface nearest to a station of the path, on one side of it.
    Point3 wallAt(double station_mm) const
    {
        const PathFrame frame = path.at(station_mm);
        std::size_t best = 0;
        for (std::size_t n = 0; n < colon.cells.pointCount(); ++n)
            if (distance(colon.cells.point(n), frame.position_mm + frame.up * frame.radius_mm) <
                distance(colon.cells.point(best), frame.position_mm + frame.up * frame.radius_mm))
                best = n;
        return colon.cells.point(best);
    }
    std::vector<UnseenPatch> patches(double least_mm2 = 28) const
    {
        return unseenPatches(colon.cells.points_mm, colon.cells.triangles, coverage, colon.skeleton, path, lumen,
                             least_mm2);
    }
};

TEST_F(Unseen, PatchesLieWhereNothingWasSeenAndAreLookedAt)
{
    const double stations[] = {0.2 * path.length_mm(), 0.5 * path.length_mm(), 0.8 * path.length_mm()};
    std::vector<Point3> places;
    for (const double s : stations)
        places.push_back(wallAt(s));
    seeAllBut(places, 6);
    const auto found = patches();
    ASSERT_EQ(found.size(), places.size());
    double area = 0;
    const Lens lens{90, 200, 200};
    for (const UnseenPatch& patch : found) {
        area += patch.area_mm2;
        const auto place = std::min_element(places.begin(), places.end(), [&](Point3 a, Point3 b) {
            return distance(a, patch.centre_mm) < distance(b, patch.centre_mm);
        });
        EXPECT_LT(distance(*place, patch.centre_mm), 2.5);
        EXPECT_NEAR(patch.area_mm2, std::numbers::pi * 36, 0.35 * std::numbers::pi * 36);  // a disc on a bent wall
        EXPECT_NEAR(patch.station_mm, stations[std::size_t(place - places.begin())], 12);
        EXPECT_TRUE(patch.view.sees_target);
        const Projected middle = project(patch.view.pose, lens, patch.centre_mm);
        EXPECT_NEAR(middle.at.x, 100, 1e-6);
        EXPECT_NEAR(middle.at.y, 100, 1e-6);
        EXPECT_GT(middle.depth_mm, 0);
        EXPECT_TRUE(std::is_sorted(patch.triangles.begin(), patch.triangles.end()));
    }
    EXPECT_NEAR(area, coverage.wholeArea_mm2() - coverage.seenArea_mm2(), 1e-3 * area);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](auto& a, auto& b) { return a.area_mm2 > b.area_mm2; }));
}

TEST_F(Unseen, PatchesHoldEachUnseenTriangleOnceAndCrossTheBordersOfCells)
{
    // Where two cells meet.
    std::size_t border = 0;
    std::set<int> around;
    for (std::size_t t = 0; t < colon.cells.triangleCount() && around.size() < 2; t += 7) {
        border = t;
        around.clear();
        for (std::size_t n = 0; n < colon.cells.triangleCount(); ++n)
            if (distance(middleOf(n), middleOf(border)) < 5)
                around.insert(colon.cells.segment[n]);
    }
    ASSERT_GE(around.size(), 2U);
    seeAllBut({middleOf(border)}, 5);
    std::set<std::uint32_t> listed;
    std::set<int> of_largest;
    std::size_t count = 0;
    const auto found = patches(0);
    for (const UnseenPatch& patch : found) {
        listed.insert(patch.triangles.begin(), patch.triangles.end());
        count += patch.triangles.size();
    }
    ASSERT_FALSE(found.empty());
    for (const std::uint32_t t : found.front().triangles)
        of_largest.insert(colon.cells.segment[t]);
    EXPECT_EQ(of_largest, around);
    EXPECT_EQ(listed.size(), count);
    EXPECT_EQ(count, coverage.triangleCount() - coverage.seenCount());
}

TEST_F(Unseen, TheStationIsOneOfTheLoopThatIsLookedAt)
{
    const double station_mm = 0.5 * path.length_mm();
    const Point3 place = wallAt(station_mm);
    seeAllBut({place}, 6);
    // A narrow loop runs right behind the wall there.
    Skeleton with_loop = colon.skeleton;
    const double end_mm = with_loop.length_mm();
    const Vector3 outwards = normalized(place - path.at(station_mm).position_mm);
    SkeletonPiece loop;
    for (int n = 0; n <= 20; ++n)
        loop.points.push_back({place + outwards * 2 + path.at(station_mm).up * double(n - 10), end_mm + 300 + n, 1});
    with_loop.pieces.push_back(loop);
    ASSERT_GT(with_loop.nearest(place).station_mm, end_mm + 300);
    const auto found =
        unseenPatches(colon.cells.points_mm, colon.cells.triangles, coverage, with_loop, path, lumen, 28);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found.front().station_mm, station_mm, 12);
}

TEST_F(Unseen, SmallPatchesAreLeftOut)
{
    seeAllBut({wallAt(0.3 * path.length_mm()), wallAt(0.7 * path.length_mm())}, 4);
    EXPECT_EQ(patches(20).size(), 2U);
    EXPECT_TRUE(patches(90).empty());
    seeAllBut({}, 0);
    EXPECT_TRUE(patches(0).empty());
}

TEST_F(Unseen, PiecesThatMeetInAPointOnlyAreTwo)
{
    // Two triangles with one point in common, and a third that shares an edge with the second.
    const std::vector<float> points{0, 0, 0, 10, 0, 0, 0, 10, 0, -10, 0, 0, 0, -10, 0, -10, -10, 0};
    const std::vector<std::uint32_t> triangles{0, 1, 2, 0, 3, 4, 4, 3, 5};
    const auto found =
        unseenPatches(points, triangles, Coverage(triangleAreas_mm2(points, triangles)), colon.skeleton, path, lumen);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0].area_mm2, 100, 1e-4);
    EXPECT_EQ(found[0].triangles, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_EQ(found[1].triangles, (std::vector<std::uint32_t>{0}));
}

TEST_F(Unseen, TheCoverageOfAnotherSurfaceIsRefused)
{
    EXPECT_THROW(
        unseenPatches(colon.cells.points_mm, colon.cells.triangles, Coverage({1, 1}), colon.skeleton, path, lumen),
        Error);
}

}  // namespace
}  // namespace vicon::viewer

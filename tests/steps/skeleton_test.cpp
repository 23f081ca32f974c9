#include "vicon/steps/skeleton.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numbers>

#include "segment_shapes.h"

namespace vicon::steps {
namespace {

using test::centredGrid;
using test::drawMask;
using test::tubeDistance;

struct Curve {
    const char* name;
    std::vector<Point3> line;
    double radius_mm;
};

using Polyline = std::vector<Point3>;

std::vector<Point3> sampled(int count, const std::function<Point3(double)>& at)
{
    std::vector<Point3> line;
    for (int n = 0; n <= count; ++n)
        line.push_back(at(double(n) / count));
    return line;
}

std::vector<Curve> closedForms()
{
    using std::numbers::pi;
    return {{"straight", {{0, 0, -50}, {0, 0, 50}}, 9},
            {"oblique", {{-30, -20, -40}, {30, 20, 40}}, 10},
            {"helix",
             sampled(200,
                     [](double t) {
                         return Point3{30 * std::cos(3 * pi * t), 30 * std::sin(3 * pi * t), -45 + 90 * t};
                     }),
             8},
            {"torus segment",
             sampled(200,
                     [](double t) {
                         return Point3{40 * std::cos(1.5 * pi * t - pi / 2), 0, 40 * std::sin(1.5 * pi * t - pi / 2)};
                     }),
             9}};
}

double lengthOf(const std::vector<Point3>& line)
{
    double length = 0;
    for (std::size_t n = 1; n < line.size(); ++n)
        length += distance(line[n - 1], line[n]);
    return length;
}

class ClosedForm : public testing::TestWithParam<int> {};

TEST_P(ClosedForm, IsFollowedInTheMiddleFromEndToEnd)
{
    const Curve curve = closedForms()[std::size_t(GetParam())];
    SCOPED_TRACE(curve.name);
    const InsideVolume mask = drawMask(centredGrid({120, 120, 140}, 1),
                                       [&](Point3 p) { return tubeDistance(curve.line, curve.radius_mm, p) < 0; });
    NoProgress progress;
    LumenPlan plan = planForMask(mask);
    ASSERT_EQ(plan.pieces.size(), 1U);
    const SkeletonResult result = findSkeleton(mask, plan, {}, progress);
    ASSERT_EQ(result.curve.pieces.size(), 1U);
    double station = 0;
    for (const SkeletonPoint& p : result.curve.pieces.front().points) {
        EXPECT_LT(tubeDistance(curve.line, 0, p.position_mm), 1.0);
        // A mask of 1 mm voxels knows its wall to a voxel's diagonal at best.
        EXPECT_NEAR(p.radius_mm, curve.radius_mm, 1.5);
        EXPECT_GE(p.station_mm, station);
        EXPECT_NE(mask.valueOr(mask.grid.indexAt(p.position_mm), kOutside), kOutside);
        station = p.station_mm;
    }
    EXPECT_NEAR(result.curve.length_mm(), lengthOf(curve.line), 0.01 * lengthOf(curve.line) + 2);
}

INSTANTIATE_TEST_SUITE_P(Curves, ClosedForm, testing::Range(0, 4));

TEST(Skeleton, VoxelPathIs26ConnectedAndInside)
{
    const Curve helix = closedForms()[2];
    const InsideVolume mask = drawMask(centredGrid({100, 100, 120}, 1),
                                       [&](Point3 p) { return tubeDistance(helix.line, helix.radius_mm, p) < 0; });
    NoProgress progress;
    const SkeletonResult result = findSkeleton(mask, planForMask(mask), {}, progress);
    ASSERT_EQ(result.voxels.size(), 1U);
    for (std::size_t n = 0; n < result.voxels[0].size(); ++n) {
        const Index3 v = mask.grid.indexAt(result.voxels[0][n]);
        ASSERT_NE(mask.at(v), kOutside);
        if (n == 0)
            continue;
        const Index3 u = mask.grid.indexAt(result.voxels[0][n - 1]);
        EXPECT_EQ(std::max({std::abs(u.i - v.i), std::abs(u.j - v.j), std::abs(u.k - v.k)}), 1);
    }
}

TEST(Skeleton, KeepsToTheWidePartOfAFlatLumen)
{
    // A channel beside a slit of about the same area: the middle of a section lies in the slit.
    const Curve channel{"channel", {{-12, 0, -50}, {-12, 0, 50}}, 4};
    const InsideVolume mask = drawMask(centredGrid({80, 40, 140}, 1), [&](Point3 p) {
        const bool in_slit = std::abs(p.y) < 2.6 && p.x > -12 && p.x < 16 && std::abs(p.z) < 50;
        return in_slit || tubeDistance(channel.line, channel.radius_mm, p) < 0;
    });
    NoProgress progress;
    LumenPlan plan = planForMask(mask);
    ASSERT_EQ(plan.pieces.size(), 1U);
    plan.pieces.front().rectal_end_mm = channel.line.front();
    plan.pieces.front().caecal_end_mm = channel.line.back();
    const SkeletonResult result = findSkeleton(mask, plan, {}, progress);
    for (const SkeletonPoint& p : result.curve.pieces.front().points)
        EXPECT_LT(tubeDistance(channel.line, 0, p.position_mm), 0.75 * channel.radius_mm + 1) << p.station_mm;
}

TEST(Skeleton, GoesAroundALoopThatTouchesItself)
{
    // Two limbs of a hairpin whose walls merge over a few voxels half-way up.
    const std::vector<Point3> hairpin = sampled(200, [](double t) {
        if (t < 0.4)
            return Point3{-11, 0, -50 + 75 * t / 0.4};
        if (t > 0.6)
            return Point3{11, 0, 25 - 75 * (t - 0.6) / 0.4};
        const double angle = std::numbers::pi * (1 - (t - 0.4) / 0.2);
        return Point3{11 * std::cos(angle), 0, 25 + 11 * std::sin(angle)};
    });
    const InsideVolume mask = drawMask(centredGrid({70, 50, 140}, 1), [&](Point3 p) {
        const bool contact = std::abs(p.x) < 4 && std::hypot(p.y, p.z + 20) < 3;
        return tubeDistance(hairpin, 9, p) < 0 || contact;
    });
    NoProgress progress;
    LumenPlan plan;
    plan.pieces.push_back({{-11, 0, -57}, {11, 0, -57}});
    const SkeletonResult result = findSkeleton(mask, plan, {}, progress);
    EXPECT_NEAR(result.curve.length_mm(), lengthOf(hairpin), 6);
}

TEST(Skeleton, DoesNotDependOnTheNumberOfThreads)
{
    const Curve helix = closedForms()[2];
    const InsideVolume mask = drawMask(centredGrid({100, 100, 120}, 1),
                                       [&](Point3 p) { return tubeDistance(helix.line, helix.radius_mm, p) < 0; });
    NoProgress progress;
    const LumenPlan plan = planForMask(mask);
    const SkeletonResult many = findSkeleton(mask, plan, {}, progress);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const SkeletonResult one = findSkeleton(mask, plan, {}, progress);
    ASSERT_EQ(one.curve.pieces.size(), many.curve.pieces.size());
    const auto &a = one.curve.pieces[0].points, &b = many.curve.pieces[0].points;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t n = 0; n < a.size(); ++n)
        EXPECT_EQ(a[n].position_mm, b[n].position_mm);
}

TEST(Skeleton, JoinsPiecesByABridgeWithStationsThatGoOn)
{
    const InsideVolume mask = drawMask(centredGrid({50, 50, 140}, 1), [](Point3 p) {
        return tubeDistance({{0, 0, -50}, {0, 0, -15}}, 8, p) < 0 || tubeDistance({{0, 0, 15}, {0, 0, 50}}, 8, p) < 0;
    });
    LumenPlan plan;
    plan.pieces.push_back({{0, 0, -57}, {0, 0, -8}});
    plan.pieces.push_back({{0, 0, 8}, {0, 0, 57}});
    plan.bridges.push_back({{0, 0, -8}, {0, 0, 8}, {{0, 0, -8}, {0, 0, 8}}, 16, 0.9, "", true});
    NoProgress progress;
    const SkeletonResult result = findSkeleton(mask, plan, {}, progress);
    ASSERT_EQ(result.curve.pieces.size(), 3U);
    EXPECT_TRUE(result.curve.pieces[1].bridge);
    EXPECT_EQ(result.curve.pieces[1].points.front().position_mm, result.curve.pieces[0].points.back().position_mm);
    EXPECT_EQ(result.curve.pieces[1].points.back().station_mm, result.curve.pieces[2].points.front().station_mm);
    EXPECT_NEAR(result.curve.length_mm(), 100, 3);
}

TEST(Skeleton, StaysInTheMiddleBesideACollapsedPartInABend)
{
    // Three quarters of a ring, collapsed over 14 mm in the middle. There the lumen closes within 10 mm.
    constexpr double kBend_mm = 27, kRadius_mm = 14, kCollapsed_mm = 7, kRamp_mm = 10;
    const auto on_ring = [](double along_mm) {
        const double angle = along_mm / kBend_mm;
        return Point3{kBend_mm * std::cos(angle), kBend_mm * std::sin(angle), 0};
    };
    const auto off_ring = [](Point3 p) { return std::hypot(std::hypot(p.x, p.y) - kBend_mm, p.z); };
    const InsideVolume mask = drawMask(centredGrid({90, 90, 34}, 1), [&](Point3 p) {
        const double along_mm = std::abs(std::atan2(p.y, p.x)) * kBend_mm;
        const double closed = 1 - std::clamp((along_mm - kCollapsed_mm) / kRamp_mm, 0.0, 1.0);
        return along_mm < 63 && off_ring(p) < kRadius_mm * std::sqrt(1 - closed * closed);
    });
    const Polyline way{on_ring(-kCollapsed_mm), on_ring(-3), on_ring(0), on_ring(3), on_ring(kCollapsed_mm)};
    LumenPlan plan;
    plan.pieces = {{on_ring(-61), way.front()}, {way.back(), on_ring(61)}};
    plan.bridges.push_back({way.front(), way.back(), way, 14, 0.9, "", true});
    NoProgress progress;
    const SkeletonResult result = findSkeleton(mask, plan, {}, progress);
    ASSERT_EQ(result.curve.pieces.size(), 3U);
    for (const SkeletonPiece& piece : result.curve.pieces)
        for (const SkeletonPoint& p : piece.points)
            if (std::abs(std::atan2(p.position_mm.y, p.position_mm.x)) * kBend_mm < 35) {
                EXPECT_LT(off_ring(p.position_mm), 0.35);
            }
}

/// Folds on one side of a wide tube and on the other by turns, as in the second phantom's ascending colon.
InsideVolume wideWithFolds(double apart_mm, double radius_mm)
{
    constexpr double kDepth_mm = 17, kHalf_mm = 2, kHalfLength_mm = 105;
    return drawMask(centredGrid({60, 60, 220}, 1), [&](Point3 p) {
        const double fold = std::round(p.z / apart_mm);
        const double side = int(fold) % 2 == 0 ? 1 : -1;
        const bool in_fold = std::abs(p.z - fold * apart_mm) < kHalf_mm && side * p.x > radius_mm - kDepth_mm;
        return std::hypot(p.x, p.y) < radius_mm && std::abs(p.z) < kHalfLength_mm && !in_fold;
    });
}

TEST(Skeleton, DoesNotSwingBetweenFoldsOfAWideLumen)
{
    for (const double apart_mm : {20.0, 24.0, 27.0}) {  // it did by 6.6, 8.1 and 0.2 mm
        const InsideVolume mask = wideWithFolds(apart_mm, 26);
        NoProgress progress;
        const SkeletonResult result = findSkeleton(mask, planForMask(mask), {}, progress);
        ASSERT_EQ(result.curve.pieces.size(), 1U);
        for (const SkeletonPoint& p : result.curve.pieces.front().points)
            if (std::abs(p.position_mm.z) < 70) {
                EXPECT_LT(std::hypot(p.position_mm.x, p.position_mm.y), 1) << apart_mm << " " << p.position_mm.z;
            }
    }
}

TEST(Skeleton, OfNothingIsEmpty)
{
    const InsideVolume mask(centredGrid({10, 10, 10}, 1));
    NoProgress progress;
    EXPECT_TRUE(planForMask(mask).pieces.empty());
    EXPECT_TRUE(findSkeleton(mask, {}, {}, progress).curve.empty());
}

}  // namespace
}  // namespace vicon::steps

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/visibility.h"

namespace vicon::viewer {
namespace {

Gate gateAt(int a, int b, Point3 centre, double half)
{
    Gate gate{a, b, {}};
    for (int n = 0; n < 8; ++n)
        gate.box_mm[std::size_t(n)] = centre + Vector3{n & 1 ? half : -half, n & 2 ? half : -half, n & 4 ? 1. : -1.};
    return gate;
}

std::vector<int> numbers(const std::vector<VisibleSegment>& seen)
{
    std::vector<int> out;
    for (const VisibleSegment& s : seen)
        out.push_back(s.segment);
    std::sort(out.begin(), out.end());
    return out;
}

TEST(Visibility, GoesThroughGatesInSightOnly)
{
    // Along z: two gates in a row; one to the side, out of the picture; one behind.
    const Visibility visibility({gateAt(1, 2, {0, 0, 20}, 4), gateAt(2, 3, {0, 0, 60}, 4), gateAt(1, 4, {60, 0, 5}, 4),
                                 gateAt(1, 5, {0, 0, -30}, 4), gateAt(2, 6, {40, 0, 50}, 4)});
    const Pose ahead = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
    const Lens lens{90, 100, 100};
    // Gate 2-6 lies in the picture, but not in the part of it that gate 1-2 leaves.
    EXPECT_EQ(numbers(visibility.visibleFrom(ahead, lens, 1)), (std::vector<int>{1, 2, 3}));
    const Pose back = lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
    EXPECT_EQ(numbers(visibility.visibleFrom(back, lens, 1)), (std::vector<int>{1, 5}));
}

TEST(Visibility, AGateAroundTheEyeHidesNothing)
{
    const Visibility visibility({gateAt(1, 2, {0, 0, 0}, 4)});
    for (const Vector3 way : {Vector3{0, 0, 1}, Vector3{0, 0, -1}, Vector3{1, 0, 0}}) {
        const Pose pose = lookAt({0, 0, 0}, Point3{} + way, {0, 1, 0});
        EXPECT_EQ(numbers(visibility.visibleFrom(pose, {90, 100, 100}, 1)), (std::vector<int>{1, 2}));
        const ViewRectangle r = rectangleOf(visibility.gates()[0], pose);
        EXPECT_TRUE(r.contains(wholePicture({90, 100, 100})));
    }
}

TEST(Visibility, LoopsOfSegmentsEnd)
{
    const Visibility ring({gateAt(1, 2, {0, 0, 10}, 5), gateAt(2, 3, {2, 0, 20}, 5), gateAt(3, 1, {-2, 0, 15}, 5)});
    const Pose pose = lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
    EXPECT_EQ(numbers(ring.visibleFrom(pose, {90, 100, 100}, 1)), (std::vector<int>{1, 2, 3}));
}

// Whatever a straight line meets before it leaves the lumen is among what is said to be visible, and its pixel lies in
// one of the rectangles through which that is seen.
TEST(Visibility, NothingOnALineOfSightIsLeftOut)
{
    const test::TestColon colon;
    std::vector<Gate> gates;
    for (const Portal& portal : colon.subdivision.portals)
        gates.push_back({portal.segment_a, portal.segment_b, portal.box_mm});
    const Visibility visibility(gates);
    std::vector<std::size_t> inside;
    for (std::size_t n = 0; n < colon.segments.voxels.size(); ++n)
        if (colon.segments.voxels[n] != 0)
            inside.push_back(n);
    std::mt19937 random(3);
    std::normal_distribution<double> any;
    std::uniform_int_distribution<std::size_t> pick(0, inside.size() - 1);
    const Lens lens{90, 200, 160};
    std::size_t left_out = 0, drawn = 0;
    constexpr int kPoses = 300, kRays = 60;
    for (int n = 0; n < kPoses; ++n) {
        const Point3 eye = colon.segments.grid.pointAt(colon.segments.grid.indexOf(inside[pick(random)]));
        const Vector3 way = normalized({any(random), any(random), any(random)});
        const Pose pose = lookAt(eye, eye + way, {any(random), any(random), any(random)});
        const auto seen = visibility.visibleFrom(pose, lens, colon.segments.at(colon.segments.grid.indexAt(eye)));
        drawn += seen.size();
        for (int ray = 0; ray < kRays; ++ray) {
            const Pixel pixel{std::uniform_real_distribution<double>(0, 200)(random),
                              std::uniform_real_distribution<double>(0, 160)(random)};
            const Vector3 direction = rayThrough(pose, lens, pixel);
            const double x = dot(direction, pose.right()) / dot(direction, pose.forward);
            const double y = dot(direction, pose.up) / dot(direction, pose.forward);
            for (double at = 0;; at += 0.25) {
                const int segment =
                    colon.segments.valueOr(colon.segments.grid.indexAt(eye + direction * at), std::uint16_t(0));
                if (segment == 0)
                    break;
                const auto found = std::find_if(seen.begin(), seen.end(),
                                                [&](const VisibleSegment& s) { return s.segment == segment; });
                const bool there = found != seen.end() && std::any_of(found->through.begin(), found->through.end(),
                                                                      [&](const ViewRectangle& r) {
                                                                          return r.contains({x, x, y, y});
                                                                      });
                left_out += there ? 0 : 1;
            }
        }
    }
    EXPECT_EQ(left_out, 0U);
    const double all = double(colon.segments.voxels.empty() ? 0 : kPoses) *
                       *std::max_element(colon.segments.voxels.begin(), colon.segments.voxels.end());
    EXPECT_LT(double(drawn), 0.5 * all);  // and yet most of the colon is not drawn
}

}  // namespace
}  // namespace vicon::viewer

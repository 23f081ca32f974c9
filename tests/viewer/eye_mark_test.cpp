// Where the eye is and where it looks, as slices and the projection of the colon show it.
#include <gtest/gtest.h>

#include <cmath>

#include "scan_fixture.h"
#include "vicon/viewer/scene/reading_pictures.h"

namespace vicon::viewer {
namespace {

const Point3 kElsewhere{1e5, 1e5, 1e5};  // its mark lies outside of every picture

Pose poseAt(Point3 eye, Vector3 forward)
{
    return {eye, forward, uprightOn(forward, {0.1, 0.2, 0.97})};
}

/// Where two pictures of one thing differ.
struct Difference {
    int count = 0;
    Pixel middle, low{1e9, 1e9}, high{-1e9, -1e9};
};

Difference between(const Picture& a, const Picture& b)
{
    Difference found;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            if (!(a.at(x, y) == b.at(x, y))) {
                ++found.count;
                found.middle.x += x + 0.5;
                found.middle.y += y + 0.5;
                found.low = {std::min(found.low.x, x + 0.5), std::min(found.low.y, y + 0.5)};
                found.high = {std::max(found.high.x, x + 0.5), std::max(found.high.y, y + 0.5)};
            }
    found.middle.x /= std::max(1, found.count);
    found.middle.y /= std::max(1, found.count);
    return found;
}

/// The mark is a ring around the eye and, unless the eye looks across the picture's plane, an arrow the way it looks.
void expectMarks(const Difference& mark, const PlaneView& view, const Pose& pose)
{
    ASSERT_GT(mark.count, 20);
    const Pixel eye = view.toPixel(pose.eye_mm);
    const double x = dot(pose.forward, view.right), y = dot(pose.forward, view.down), share = std::hypot(x, y);
    const double off_x = mark.middle.x - eye.x, off_y = mark.middle.y - eye.y;
    if (share < 0.1) {
        EXPECT_NEAR(off_x, 0, 1);
        EXPECT_NEAR(off_y, 0, 1);
        return;
    }
    const double along = (off_x * x + off_y * y) / share, across = (off_x * -y + off_y * x) / share;
    EXPECT_GT(along, 4) << "the arrow lies on the side that the eye looks to";
    EXPECT_LT(std::abs(across), 1.5) << "and points that way";
    EXPECT_LE(mark.low.x, eye.x);  // the ring is around the eye
    EXPECT_GE(mark.high.x, eye.x);
    EXPECT_LE(mark.low.y, eye.y);
    EXPECT_GE(mark.high.y, eye.y);
}

const Vector3 kWays[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},     {0, -1, 0},
                         {0, 0, 1}, {0, 0, -1}, {0.6, 0, 0.8}, {0, -0.8, 0.6}};

TEST(EyesMark, LiesInEverySliceWhereTheEyeIsAndPointsWhereItLooks)
{
    const HuVolume volume(Grid{.size = {4, 4, 4}, .origin_mm = {-150, -150, -150}, .spacing_mm = {100, 100, 100}}, 0);
    struct Plane {
        SlicePlane plane;
        Vector3 right, down;
    };
    for (const Plane& plane :
         {Plane{SlicePlane::axial, {1, 0, 0}, {0, 1, 0}}, Plane{SlicePlane::coronal, {1, 0, 0}, {0, 0, -1}},
          Plane{SlicePlane::sagittal, {0, 1, 0}, {0, 0, -1}}})
        for (const Vector3 forward : kWays) {
            SliceRequest request{.plane = plane.plane,
                                 .view = {{0, 0, 0}, plane.right, plane.down, 0.5, 500, 400},
                                 .point_mm = kElsewhere,
                                 .pose = poseAt(kElsewhere, forward)};
            const Picture without = slicePicture(volume, request);
            request.pose = poseAt({23, 31, -27}, forward);
            expectMarks(between(without, slicePicture(volume, request)), request.view, request.pose);
        }
}

struct EyesMarks : test::ColonFixture {};

TEST_F(EyesMarks, LiesInTheProjectionWhereTheEyeIsAndPointsWhereItLooks)
{
    const PreparedScan prepared = scan();
    ReadingPictures pictures(prepared);
    SnapshotRequest request;
    request.view = SnapshotView::overview;
    request.width = 800;
    request.height = 700;
    const Point3 eye = prepared.frames().at(prepared.frames().length_mm() / 2).position_mm;
    for (const Vector3 forward : kWays) {
        const SnapshotResult elsewhere{.pose = poseAt(kElsewhere, forward)}, here{.pose = poseAt(eye, forward)};
        const auto without = pictures.overview(request, elsewhere), with = pictures.overview(request, here);
        expectMarks(between(without.picture, with.picture), with.view, here.pose);
    }
}

}  // namespace
}  // namespace vicon::viewer

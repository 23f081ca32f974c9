#include "vicon/viewer/model/cube.h"

#include <algorithm>

namespace vicon::viewer {
namespace {

constexpr int kColumns = 4, kRows = 3;

struct Slot {
    int column, row;
};

Slot slotOf(CubeFace face)
{
    switch (face) {
        case CubeFace::left:
            return {0, 1};
        case CubeFace::front:
            return {1, 1};
        case CubeFace::right:
            return {2, 1};
        case CubeFace::back:
            return {3, 1};
        case CubeFace::top:
            return {1, 0};
        case CubeFace::bottom:
            return {1, 2};
    }
    return {1, 1};
}

}  // namespace

Pose poseOf(CubeFace face, const Pose& eye)
{
    const Vector3 right = eye.right();
    switch (face) {
        case CubeFace::left:
            return {eye.eye_mm, -right, eye.up};
        case CubeFace::front:
            return eye;
        case CubeFace::right:
            return {eye.eye_mm, right, eye.up};
        case CubeFace::back:
            return {eye.eye_mm, -eye.forward, eye.up};
        case CubeFace::top:
            return {eye.eye_mm, eye.up, -eye.forward};
        case CubeFace::bottom:
            return {eye.eye_mm, -eye.up, eye.forward};
    }
    return eye;
}

CubeLayout::CubeLayout(int width, int height) : side_(std::max(1, std::min(width / kColumns, height / kRows)))
{
    const int left = (width - kColumns * side_) / 2, top = (height - kRows * side_) / 2;
    corner_ = {double(left), double(top)};
}

Pixel CubeLayout::cornerOf(CubeFace face) const
{
    const Slot slot = slotOf(face);
    return {corner_.x + slot.column * side_, corner_.y + slot.row * side_};
}

std::optional<CubeFace> CubeLayout::faceAt(Pixel at) const
{
    for (const CubeFace face : kCubeFaces) {
        const Pixel corner = cornerOf(face);
        if (at.x >= corner.x && at.y >= corner.y && at.x < corner.x + side_ && at.y < corner.y + side_)
            return face;
    }
    return std::nullopt;
}

std::optional<Vector3> CubeLayout::rayThrough(const Pose& eye, Pixel at) const
{
    const auto face = faceAt(at);
    if (!face)
        return std::nullopt;
    const Pixel corner = cornerOf(*face);
    return viewer::rayThrough(poseOf(*face, eye), lens(), {at.x - corner.x, at.y - corner.y});
}

Pixel CubeLayout::toPixel(const Pose& eye, Point3 p) const
{
    // The face whose direction is nearest to the point's.
    const auto along = [&](CubeFace face) { return dot(p - eye.eye_mm, poseOf(face, eye).forward); };
    const CubeFace face = *std::max_element(kCubeFaces.begin(), kCubeFaces.end(),
                                            [&](CubeFace a, CubeFace b) { return along(a) < along(b); });
    const Pixel corner = cornerOf(face), at = project(poseOf(face, eye), lens(), p).at;
    return {corner.x + at.x, corner.y + at.y};
}

std::optional<std::pair<Pixel, Pixel>> CubeLayout::partOn(CubeFace face, const Pose& eye, Point3 from, Point3 to) const
{
    constexpr double kLeastDepth_mm = 1e-3;  // what lies in the eye has no place
    const Pose pose = poseOf(face, eye);
    const Vector3 right = pose.right();
    const auto off = [&](Point3 p) { return p - eye.eye_mm; };
    double begin = 0, end = 1;  // of the line
    // A face is bounded by four planes through the eye; it shows what lies on the inner side of all.
    const auto cut = [&](double at_from, double at_to) {
        if (at_from < 0 && at_to < 0)
            end = -1;
        else if (at_from < 0)
            begin = std::max(begin, at_from / (at_from - at_to));
        else if (at_to < 0)
            end = std::min(end, at_from / (at_from - at_to));
    };
    for (const Vector3 inwards :
         {pose.forward + right, pose.forward - right, pose.forward + pose.up, pose.forward - pose.up})
        cut(dot(off(from), inwards), dot(off(to), inwards));
    cut(dot(off(from), pose.forward) - kLeastDepth_mm, dot(off(to), pose.forward) - kLeastDepth_mm);
    if (begin >= end)
        return std::nullopt;
    const Pixel corner = cornerOf(face);
    const auto place = [&](double along) {
        const Pixel at = project(pose, lens(), interpolate(from, to, along)).at;
        return Pixel{corner.x + at.x, corner.y + at.y};
    };
    return std::pair(place(begin), place(end));
}

}  // namespace vicon::viewer

#include "vicon/viewer/model/tracked_lumen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace vicon::viewer {
namespace {

constexpr double kMostAlong_mm = 4;  // a polyp of 6 mm stays in the picture's middle for more than one slice
constexpr double kWalk_mm = 0.25;    // a quarter of the frames' distance
constexpr double kLookFor_mm = 3;    // the centreline runs outside the lumen where it bridges a collapsed segment

double oneSliceOn(const PathFrames& path, double station_mm, Vector3 across, double slice_mm, double direction)
{
    const Point3 from = path.at(station_mm).position_mm;
    double station = station_mm;
    for (double walked = kWalk_mm; walked <= kMostAlong_mm; walked += kWalk_mm) {
        station = std::clamp(station_mm + direction * walked, 0.0, path.length_mm());
        if (std::abs(dot(path.at(station).position_mm - from, across)) >= slice_mm)
            break;
    }
    return station;
}

/// The pixels of a picture and how much of each place is lumen.
class LumenPixels {
public:
    LumenPixels(const InsideView& inside, const PlaneView& view)
        : inside_(inside),
          view_(view),
          shares_((std::size_t(view.width) + 2) * (std::size_t(view.height) + 2), kUnknown)
    {
    }

    bool inPicture(int x, int y) const { return x >= 0 && y >= 0 && x < view_.width && y < view_.height; }
    bool has(int x, int y) { return inPicture(x, y) && shareAt(x, y) >= kHalf; }
    std::size_t offset(int x, int y) const { return std::size_t(y) * std::size_t(view_.width) + std::size_t(x); }

    /// The pixel of the lumen nearest to a place.
    std::optional<std::pair<int, int>> nearest(Pixel at)
    {
        const int reach = int(std::ceil(kLookFor_mm / view_.mm_per_pixel));
        std::optional<std::pair<int, int>> found;
        double least = (reach + 0.5) * (reach + 0.5);
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx)
                if (const double d = dx * dx + dy * dy;
                    d < least && has(int(std::floor(at.x)) + dx, int(std::floor(at.y)) + dy)) {
                    least = d;
                    found = {int(std::floor(at.x)) + dx, int(std::floor(at.y)) + dy};
                }
        return found;
    }

    /// From a pixel's middle to where the lumen ends, in pixels: from where it crosses the lines to the four
    /// neighbours.
    double toRim(int x, int y)
    {
        const double along = std::min(crossing(x, y, -1, 0), crossing(x, y, 1, 0));
        const double down = std::min(crossing(x, y, 0, -1), crossing(x, y, 0, 1));
        return along > 1 || down > 1 ? std::min(along, down) : along * down / std::max(1e-9, std::hypot(along, down));
    }

private:
    static constexpr double kHalf = 0.5;
    static constexpr float kUnknown = -1;

    double crossing(int x, int y, int dx, int dy)
    {
        constexpr double kNone = 2;
        const double here = shareAt(x, y) - kHalf, there = shareAt(x + dx, y + dy) - kHalf;
        return (here >= 0) == (there >= 0) ? kNone : here / (here - there);
    }

    /// Of a pixel in the picture or beside it.
    float shareAt(int x, int y)
    {
        float& share = shares_[(std::size_t(y) + 1) * (std::size_t(view_.width) + 2) + std::size_t(x) + 1];
        if (share == kUnknown)
            share = float(shareAt(inside_.grid.continuousIndexAt(view_.pointAt({x + 0.5, y + 0.5}))));
        return share;
    }

    /// Trilinear: the voxels' own edges would be teeth where the slice lies askew to them.
    double shareAt(ContinuousIndex3 c) const
    {
        const Index3 low{int(std::floor(c.i)), int(std::floor(c.j)), int(std::floor(c.k))};
        const double i = c.i - low.i, j = c.j - low.j, k = c.k - low.k;
        double share = 0;
        for (int n = 0; n < 8; ++n) {
            const int a = n & 1, b = n >> 1 & 1, d = n >> 2;
            if (inside_.valueOr({low.i + a, low.j + b, low.k + d}, std::uint8_t(0)) != 0)
                share += (a ? i : 1 - i) * (b ? j : 1 - j) * (d ? k : 1 - k);
        }
        return share;
    }

    const InsideView& inside_;
    const PlaneView& view_;
    std::vector<float> shares_;  // with an edge of a pixel all around
};

/// Of a line 1.5 pixels wide, what covers a pixel so far from it.
float coverOf(double from_line_px)
{
    constexpr double kHalfWidth_px = 0.75;
    return float(std::clamp(kHalfWidth_px + 0.5 - from_line_px, 0.0, 1.0));
}

constexpr std::array<std::pair<int, int>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

}  // namespace

double stationSlicesOn(const PathFrames& path, double station_mm, Vector3 across, double slice_mm, int slices)
{
    for (int n = 0; n < std::abs(slices); ++n)
        station_mm = oneSliceOn(path, station_mm, across, slice_mm, slices > 0 ? 1 : -1);
    return station_mm;
}

SliceAxes axesAcross(const PathFrames& way, Point3 point, const Pose& eye)
{
    if (!way.isPath())  // across the view
        return {eye.right(), eye.up * -1};
    const auto nearest = [&](Point3 p) {
        const double middle = way.length_mm() / 2;
        return way.at(way.nearestStation(p, middle, middle));
    };
    const PathFrame here = nearest(eye.eye_mm), there = nearest(point);
    const double roll = std::atan2(dot(eye.up, cross(here.forward, here.up)), dot(eye.up, here.up));
    const Vector3 up = there.up * std::cos(roll) + cross(there.forward, there.up) * std::sin(roll);
    const Vector3 forward = there.forward * (dot(eye.forward, here.forward) < 0 ? -1 : 1);
    return {cross(forward, up), up * -1};
}

std::vector<float> lumenRim(const InsideView& inside, const PlaneView& view, Point3 in_lumen)
{
    std::vector<float> rim(std::size_t(view.width) * std::size_t(view.height), 0);
    LumenPixels pixels(inside, view);
    const auto start = pixels.nearest(view.toPixel(in_lumen));
    if (!start)
        return rim;
    std::vector<std::uint8_t> met(rim.size(), 0);
    std::vector<std::pair<int, int>> to_visit{*start};
    met[pixels.offset(start->first, start->second)] = 1;
    while (!to_visit.empty()) {
        const auto [x, y] = to_visit.back();
        to_visit.pop_back();
        for (const auto& [dx, dy] : kBeside) {
            const int bx = x + dx, by = y + dy;
            if (!pixels.inPicture(bx, by) || met[pixels.offset(bx, by)])
                continue;
            if (!pixels.has(bx, by)) {
                rim[pixels.offset(x, y)] = coverOf(pixels.toRim(x, y));
                rim[pixels.offset(bx, by)] = coverOf(pixels.toRim(bx, by));
                continue;
            }
            met[pixels.offset(bx, by)] = 1;
            to_visit.emplace_back(bx, by);
        }
    }
    return rim;
}

}  // namespace vicon::viewer

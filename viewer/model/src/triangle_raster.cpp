#include "vicon/viewer/model/triangle_raster.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

/// Twice the signed area of a triangle.
double area2(const FlatCorner& a, const FlatCorner& b, double x, double y)
{
    return (double(b.x) - a.x) * (y - a.y) - (double(b.y) - a.y) * (x - a.x);
}

/// Pixels whose middles lie between the sides of a triangle; empty where an end is before the beginning.
struct PixelBox {
    int x0, x1, y0, y1;
};

PixelBox boxOf(const FlatTriangle& t, int width, int height)
{
    const auto& [a, b, c] = t.corners;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    return {int(std::ceil(std::max(left, 0.0F) - 0.5F)), int(std::floor(std::min(right, float(width)) - 0.5F)),
            int(std::ceil(std::max(top, 0.0F) - 0.5F)), int(std::floor(std::min(bottom, float(height)) - 0.5F))};
}

/// How much of a point each corner has; nothing for a triangle without area.
std::optional<std::array<double, 3>> weightsAt(const FlatTriangle& t, double x, double y)
{
    const auto& [a, b, c] = t.corners;
    const double whole = area2(a, b, c.x, c.y);
    if (whole == 0)
        return std::nullopt;
    const double of_a = area2(b, c, x, y) / whole, of_b = area2(c, a, x, y) / whole;
    return std::array{of_a, of_b, 1 - of_a - of_b};
}

}  // namespace

TriangleRaster::TriangleRaster(int width, int height)
    : width_(width),
      height_(height),
      shown_(std::size_t(width) * std::size_t(height), kNone),
      depth_(shown_.size(), std::numeric_limits<float>::infinity())
{
}

void TriangleRaster::draw(std::size_t count, const Place& place)
{
    constexpr std::size_t kRun = 8192;
    std::vector<std::vector<FlatTriangle>> runs((count + kRun - 1) / kRun);
    tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t run) {
        std::vector<FlatTriangle>& out = runs[run];
        for (std::size_t n = run * kRun; n < std::min(count, (run + 1) * kRun); ++n) {
            const std::size_t before = out.size();
            place(n, out);
            out.erase(std::remove_if(out.begin() + std::ptrdiff_t(before), out.end(),
                                     [&](const FlatTriangle& t) { return !mayShow(t); }),
                      out.end());
        }
    });
    for (const auto& run : runs)
        placed_.insert(placed_.end(), run.begin(), run.end());
    fill();
}

/// There is the middle of a pixel between its sides; of small triangles few have one.
bool TriangleRaster::mayShow(const FlatTriangle& t) const
{
    const PixelBox box = boxOf(t, width_, height_);
    return box.x0 <= box.x1 && box.y0 <= box.y1;
}

void TriangleRaster::fill()
{
    constexpr int kStripe = 64;
    tbb::parallel_for(0, (height_ + kStripe - 1) / kStripe,
                      [&](int n) { fillRows(n * kStripe, std::min(height_, (n + 1) * kStripe)); });
}

void TriangleRaster::fillRows(int first, int end)
{
    for (std::uint32_t n = 0; n < placed_.size(); ++n)
        fillTriangle(n, first, end);
}

void TriangleRaster::fillTriangle(std::uint32_t number, int first, int end)
{
    const FlatTriangle& t = placed_[number];
    const PixelBox box = boxOf(t, width_, height_);
    for (int y = std::max(first, box.y0); y <= std::min(end - 1, box.y1); ++y)
        for (int x = box.x0; x <= box.x1; ++x) {
            const auto w = weightsAt(t, x + 0.5, y + 0.5);
            if (!w || (*w)[0] < 0 || (*w)[1] < 0 || (*w)[2] < 0)
                continue;
            const std::size_t at = std::size_t(y) * std::size_t(width_) + std::size_t(x);
            const auto depth =
                float((*w)[0] * t.corners[0].depth + (*w)[1] * t.corners[1].depth + (*w)[2] * t.corners[2].depth);
            if (depth < depth_[at]) {
                depth_[at] = depth;
                shown_[at] = number;
            }
        }
}

std::optional<TriangleRaster::Hit> TriangleRaster::at(int x, int y) const
{
    const std::uint32_t number = shown_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
    if (number == kNone)
        return std::nullopt;
    const FlatTriangle& t = placed_[number];
    return Hit{t.triangle, *weightsAt(t, x + 0.5, y + 0.5)};
}

Point3 pointOf(const CellSurface& surface, const TriangleRaster::Hit& hit)
{
    Vector3 sum;
    for (std::size_t k = 0; k < 3; ++k)
        sum += (surface.point(surface.triangles[3 * std::size_t(hit.triangle) + k]) - Point3{}) * hit.weights[k];
    return Point3{} + sum;
}

}  // namespace vicon::viewer

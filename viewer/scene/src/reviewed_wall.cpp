#include "reviewed_wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "seen_tint.h"
#include "vicon/viewer/model/coverage.h"

namespace vicon::viewer {
namespace {

/// A place is larger than a triangle's edge in voxels of 1 mm and less, so that none between triangles is empty.
constexpr double kPlace_mm = 3;

}  // namespace

ReviewedWall::ReviewedWall(const CellSurface& surface, const PlaneView& view)
    : surface_(surface),
      view_(view),
      place_px_(std::max(1.0, kPlace_mm / view.mm_per_pixel)),
      width_(int(view.width / place_px_) + 2),
      height_(int(view.height / place_px_) + 2),
      areas_mm2_(triangleAreas_mm2(surface.points_mm, surface.triangles)),
      seen_(surface.triangleCount(), 0),
      places_(std::size_t(width_) * std::size_t(height_))
{
    for (std::size_t t = 0; t < areas_mm2_.size(); ++t)
        add(t, areas_mm2_[t], &Place::whole_mm2);
}

template <class Do>
void ReviewedWall::around(Pixel at, Do what) const
{
    const double x = at.x / place_px_, y = at.y / place_px_;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    for (int n = 0; n < 4; ++n) {
        const int column = left + n % 2, row = top + n / 2;
        if (column < 0 || row < 0 || column >= width_ || row >= height_)
            continue;
        const double weight = (1 - std::abs(x - column)) * (1 - std::abs(y - row));
        what(std::size_t(row) * std::size_t(width_) + std::size_t(column), float(weight));
    }
}

void ReviewedWall::add(std::size_t triangle, float area_mm2, float Place::*to)
{
    Vector3 sum;
    for (std::size_t n = 0; n < 3; ++n)
        sum += surface_.point(surface_.triangles[3 * triangle + n]) - Point3{};
    around(view_.toPixel(Point3{} + sum / 3),
           [&](std::size_t place, float weight) { places_[place].*to += weight * area_mm2; });
}

void ReviewedWall::see(const std::vector<std::uint8_t>& seen)
{
    for (std::size_t t = 0; t < std::min(seen.size(), seen_.size()); ++t) {
        if (seen[t] == seen_[t])
            continue;
        add(t, seen[t] ? areas_mm2_[t] : -areas_mm2_[t], &Place::seen_mm2);
        seen_[t] = seen[t];
    }
}

double ReviewedWall::shareAt(Pixel at) const
{
    constexpr double kRounding_mm2 = 1e-3;
    double whole_mm2 = 0, seen_mm2 = 0;
    around(at, [&](std::size_t place, float weight) {
        whole_mm2 += weight * places_[place].whole_mm2;
        seen_mm2 += weight * places_[place].seen_mm2;
    });
    return seen_mm2 > kRounding_mm2 ? std::min(1.0, seen_mm2 / whole_mm2) : 0;
}

void paintReviewed(OverviewGround& ground, const ReviewedWall& reviewed)
{
    ground.picture = ground.wall;
    tbb::parallel_for(0, ground.picture.height, [&](int y) {
        for (int x = 0; x < ground.picture.width; ++x) {
            const double share = reviewed.shareAt({x + 0.5, y + 0.5});
            if (share == 0)
                continue;
            const Rgb own = ground.picture.at(x, y), tint = seenTint(own);
            const auto mixed = [&](std::uint8_t from, std::uint8_t to) {
                return std::uint8_t(std::lround(std::lerp(double(from), double(to), share)));
            };
            ground.picture.set(x, y,
                               {mixed(own.red, tint.red), mixed(own.green, tint.green), mixed(own.blue, tint.blue)});
        }
    });
    paint(ground.picture, ground.written);
}

}  // namespace vicon::viewer

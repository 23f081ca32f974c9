#include "vicon/viewer/model/band_raster.h"

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

/// A triangle as often as a row shows it: the full turn, and what of the turns before and after is repeated.
void place(const BandMap& band, const BandPage& page, int row, double top_px, std::size_t triangle,
           std::vector<FlatTriangle>& out)
{
    const std::uint32_t* points = &band.surface().triangles[3 * triangle];
    const auto [least, most] =
        std::minmax({band.station_mm(points[0]), band.station_mm(points[1]), band.station_mm(points[2])});
    if (most < page.rowLeast_mm(row) || least > page.rowMost_mm(row))
        return;
    const auto corners = band.cornersOf(triangle);
    FlatTriangle flat{std::uint32_t(triangle), {}};
    std::array<double, 3> turn_px;  // how far a full turn is up, at each corner
    double lowest = 0, highest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Pixel at = page.toPixel(band, corners[k], row);
        turn_px[k] = BandPage::kTurn_rad * band.radiusAt_mm(corners[k].station_mm) / page.mm_per_pixel *
                     (page.from_caecum ? -1 : 1);
        flat.corners[k] = {float(at.x), float(at.y - top_px), float(band.depth_mm(points[k]))};
        lowest = std::min(lowest, corners[k].around_rad);
        highest = std::max(highest, corners[k].around_rad);
    }
    out.push_back(flat);
    const auto repeat = [&](int turn) {
        FlatTriangle again = flat;
        for (std::size_t k = 0; k < 3; ++k)
            again.corners[k].y -= float(turn * turn_px[k]);
        out.push_back(again);
    };
    constexpr double kRepeated_rad = BandPage::kTurn_rad / 2 - BandPage::kBeyond_rad;  // what lies beyond it
    if (lowest < -kRepeated_rad && highest <= 0)
        repeat(1);
    if (highest > kRepeated_rad && lowest >= 0)
        repeat(-1);
}

}  // namespace

BandRaster::BandRaster(const BandMap& band, const BandPage& page) : page_(page)
{
    for (int row = 0; row < page.rows; ++row) {
        const int top = int(std::lround(page.rowTop(row) + page.label_px));
        const int bottom = int(std::lround(page.rowTop(row) + page.rowHeight()));
        first_row_.push_back(top);
        rows_.emplace_back(page.width, std::max(1, bottom - top));
        rows_.back().draw(band.surface().triangleCount(),
                          [&](std::size_t n, std::vector<FlatTriangle>& out) { place(band, page, row, top, n, out); });
    }
}

std::optional<TriangleRaster::Hit> BandRaster::at(int x, int y) const
{
    const auto row = std::size_t(page_.rowAt({x + 0.5, y + 0.5}));
    const int in_row = y - first_row_[row];
    if (x < 0 || x >= page_.width || in_row < 0 || in_row >= rows_[row].height())
        return std::nullopt;
    return rows_[row].at(x, in_row);
}

}  // namespace vicon::viewer

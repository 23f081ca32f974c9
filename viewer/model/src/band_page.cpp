#include "vicon/viewer/model/band_page.h"

#include <algorithm>
#include <cmath>

namespace vicon::viewer {

double BandPage::rowBegin_mm(int row) const
{
    const double step = row * (rowLength_mm() - repeated_mm());
    return from_caecum ? from_mm - step : from_mm + step;
}

Pixel BandPage::toPixel(const BandMap& band, BandPlace place, int row) const
{
    const double along_mm = (place.station_mm - rowBegin_mm(row)) * (from_caecum ? -1 : 1);
    const double up_mm = place.around_rad * band.radiusAt_mm(place.station_mm) * (from_caecum ? -1 : 1);
    return {along_mm / mm_per_pixel, rowTop(row) + label_px + (rowHeight() - label_px) / 2 - up_mm / mm_per_pixel};
}

int BandPage::rowOf(double station_mm) const
{
    const double along_mm = (station_mm - from_mm) * (from_caecum ? -1 : 1);
    int row = 0;
    while (row + 1 < rows && along_mm > row * (rowLength_mm() - repeated_mm()) + rowLength_mm())
        ++row;
    return row;
}

int BandPage::rowAt(Pixel at) const
{
    return std::clamp(int(std::floor((at.y - top_px) / rowHeight())), 0, rows - 1);
}

Pixel BandPage::toPixel(const BandMap& band, BandPlace place) const
{
    return toPixel(band, place, rowOf(place.station_mm));
}

BandPlace BandPage::placeAt(const BandMap& band, Pixel at) const
{
    const int row = rowAt(at);
    const double sign = from_caecum ? -1 : 1;
    const double station = rowBegin_mm(row) + sign * at.x * mm_per_pixel;
    const double down_px = at.y - rowTop(row) - label_px - (rowHeight() - label_px) / 2;
    return {station, -sign * down_px * mm_per_pixel / band.radiusAt_mm(station)};
}

BandPage fitted(const BandMap& band, BandPage page)
{
    double widest_mm = 0;
    for (double station = 0; station <= band.path().length_mm(); station += 1)
        widest_mm = std::max(widest_mm, band.radiusAt_mm(station));
    const double turn_mm = widest_mm * (BandPage::kTurn_rad + 2 * BandPage::kBeyond_rad);
    page.mm_per_pixel = turn_mm / std::max(1.0, page.rowHeight() - page.label_px);
    return page;
}

BandPage wholeBand(const BandMap& band, BandPage page)
{
    constexpr int kMostRows = 40;
    page.from_mm = page.from_caecum ? band.lastStation_mm() : band.firstStation_mm();
    const double whole_mm = band.lastStation_mm() - band.firstStation_mm();
    BandPage best;
    for (page.rows = 1; page.rows <= kMostRows; ++page.rows) {
        page = fitted(band, page);
        page.mm_per_pixel *= std::max(1.0, whole_mm / page.length_mm());
        if (page.rows == 1 || page.mm_per_pixel < best.mm_per_pixel)
            best = page;
    }
    return best;
}

}  // namespace vicon::viewer

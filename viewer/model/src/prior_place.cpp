#include "vicon/viewer/model/prior_place.h"

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

constexpr double kWayStep_mm = 4;

/// The point of the stretch that lies near the plane and nearest to its middle; the end where there is none.
std::vector<Point3>::const_iterator crossing(const PlaneView& view, const PriorPlace& place, double depth_mm,
                                             double near_mm)
{
    auto best = place.band_mm.end();
    const auto off = [&](const auto& at) {
        return std::abs(std::distance(place.band_mm.begin(), at) - std::ptrdiff_t(place.band_mm.size() / 2));
    };
    for (auto at = place.band_mm.begin(); at != place.band_mm.end(); ++at)
        if (std::abs(view.depth_mm(*at) - depth_mm) <= near_mm && (best == place.band_mm.end() || off(at) < off(best)))
            best = at;
    return best;
}

}  // namespace

PriorPlace priorPlace(const std::string& label, const Skeleton& skeleton, double station_mm, double least_mm,
                      double most_mm)
{
    const auto within = [&](double station) { return std::clamp(station, 0.0, skeleton.length_mm()); };
    const double from = within(least_mm), to = within(most_mm);
    PriorPlace place{label, skeleton.at(within(station_mm)).position_mm, {}, within(station_mm), from, to, kPriorColor};
    const int steps = std::max(1, int(std::ceil((to - from) / kWayStep_mm)));
    for (int n = 0; n <= steps; ++n)
        place.band_mm.push_back(skeleton.at(from + (to - from) * n / steps).position_mm);
    return place;
}

PriorPlace samePlace(const std::string& label, const Skeleton& skeleton, const StationInterval& place)
{
    PriorPlace same = priorPlace(label, skeleton, place.station_mm, place.least_mm, place.most_mm);
    same.color = kSamePlaceColor;
    return same;
}

std::vector<PriorPlace> priorPlacesIn(const PriorList& priors, const ScanColon& colon, const Skeleton& skeleton,
                                      const PriorOptions& options)
{
    std::vector<PriorPlace> out;
    for (const PriorReport& report : priors.reports)
        for (const PriorFinding& finding : report.findings)
            if (const auto place = expectedIn(report, finding, colon, options); place && !skeleton.empty())
                out.push_back(
                    priorPlace(labelOf(report, finding), skeleton, place->station_mm, place->least_mm, place->most_mm));
    return out;
}

void addPriorBand(Overlay& overlay, const PlaneView& view, const PriorPlace& place, double text_px)
{
    OverlayLine band{{}, place.color, std::max(3.0, 0.3 * text_px), 0};
    for (const Point3& p : place.band_mm)
        band.points.push_back(view.toPixel(p));
    overlay.lines.push_back(std::move(band));
    overlay.discs.push_back({view.toPixel(place.position_mm), 0.45 * text_px, place.color, 2});
}

void addPriorName(Overlay& overlay, Pixel at, const PriorPlace& place, double text_px)
{
    overlay.texts.push_back(
        {{at.x + 0.7 * text_px, at.y}, place.label, 0.9 * text_px, place.color, Across::left, Along::middle, 1e9});
}

void addPriorDiamond(Overlay& overlay, const PlaneView& view, const PriorPlace& place, double depth_mm, double near_mm,
                     double radius_px, double text_px)
{
    const bool middle = std::abs(view.depth_mm(place.position_mm) - depth_mm) <= near_mm;
    const auto at = crossing(view, place, depth_mm, near_mm);
    if (!middle && at == place.band_mm.end())
        return;
    const Pixel c = view.toPixel(middle ? place.position_mm : *at);
    constexpr double kDash_px = 4;
    overlay.lines.push_back({{{c.x, c.y - radius_px},
                              {c.x + radius_px, c.y},
                              {c.x, c.y + radius_px},
                              {c.x - radius_px, c.y},
                              {c.x, c.y - radius_px}},
                             place.color,
                             2,
                             middle ? 0 : kDash_px});
    // Towards the picture's middle: in the right lower corner stands the scale bar.
    const bool to_the_left = c.x > view.width / 2.0;
    const double aside_px = radius_px * 0.6 + 2;
    overlay.texts.push_back({{to_the_left ? c.x - aside_px : c.x + aside_px, c.y + radius_px * 0.6},
                             place.label,
                             text_px,
                             place.color,
                             to_the_left ? Across::right : Across::left,
                             Along::top,
                             1e9});
}

}  // namespace vicon::viewer

#include "folds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "random.h"

namespace vicon::phantom {
namespace {

using std::numbers::pi;
constexpr double kEndClear_mm = 24;                       // no ring nearer to an end of the curve
constexpr double kDeepest = 0.5;                          // of the radius
constexpr double kGroove = 0.08;                          // of the radius, at a taenia
constexpr double kConstriction = 0.08;                    // of the radius, at a ring
constexpr double kConstrictionReach = 6;                  // mm
constexpr double kRectum = 0.075;                         // share of the length
constexpr double kClearOfFold_mm = 2.5;                   // between polyp and fold
constexpr double kHalfHeight = 0.953;                     // where the plate's profile is half as high
constexpr double kMostCrowded = 0.45, kUncrowded = 0.75;  // mm of wall per mm of station: folds fade between the two
constexpr double kPolypSpacing_mm = 60;

/// Depth of the folds along the colon: shallow on the left, deep on the right.
std::pair<double, double> depths(double fraction)
{
    if (fraction < kRectum)
        return {7, 11};  // the three valves of Houston
    if (fraction < 0.45)
        return {5, 8.5};
    return {6, 12};
}

std::vector<PolypSite> drawPolyps(std::uint64_t seed, const Relief& relief, int count)
{
    Random random(seed, "polyps");
    std::vector<PolypSite> polyps;
    const double spacing_mm = std::min(kPolypSpacing_mm, 0.4 * relief.length_mm / std::max(count, 1));
    for (int tries = 0; int(polyps.size()) < count && tries < 20000; ++tries) {
        const PolypSite site{random.uniform(0.03, 0.96) * relief.length_mm, random.uniform(-pi, pi),
                             random.uniform(5, 10)};
        bool clear = true;
        for (const PolypSite& other : polyps)
            clear = clear && std::abs(other.station_mm - site.station_mm) > spacing_mm;
        for (const Fold& fold : relief.folds)
            clear = clear && std::abs(fold.station_mm - site.station_mm) > site.diameter_mm / 2 + kClearOfFold_mm +
                                                                               fold.thickness_mm / 2 +
                                                                               std::abs(fold.slant_mm);
        if (clear)
            polyps.push_back(site);
    }
    std::sort(polyps.begin(), polyps.end(), [](auto& a, auto& b) { return a.station_mm < b.station_mm; });
    return polyps;
}

}  // namespace

double wrapped(double angle)
{
    return angle - 2 * pi * std::round(angle / (2 * pi));
}

Relief drawRelief(std::uint64_t seed, double length_mm, double thinnest_mm, int polyps)
{
    Random random(seed, "relief");
    Relief relief;
    relief.length_mm = length_mm;
    relief.taenia_phase = random.uniform(-pi, pi);
    relief.taenia_turn = random.uniform(-0.9, 0.9) * 2 * pi / length_mm;
    double at = kEndClear_mm + random.uniform(0, 12);
    while (at < length_mm - kEndClear_mm) {
        const double fraction = at / length_mm;
        relief.ring_mm.push_back(at);
        const auto [shallow, deep] = depths(fraction);
        const int only = fraction < kRectum ? random.below(3) : -1;
        for (int sector = 0; sector < 3; ++sector) {
            const bool absent = only >= 0 ? sector != only : random.uniform() < 0.12;
            const double depth = random.uniform(shallow, deep), thickness = random.uniform(2.0, 4.0);
            const double jitter = random.uniform(-4, 4), slant = random.uniform(-2.5, 2.5);
            if (!absent)
                relief.folds.push_back({at + jitter, sector, depth, std::max(thickness, thinnest_mm), slant});
        }
        at += random.uniform(20, 35);
    }
    relief.polyps = drawPolyps(seed, relief, polyps);
    return relief;
}

Relief stretched(Relief relief, double length_mm)
{
    const double factor = length_mm / relief.length_mm;
    for (double& ring : relief.ring_mm)
        ring *= factor;
    for (Fold& fold : relief.folds)
        fold.station_mm *= factor;
    for (PolypSite& polyp : relief.polyps)
        polyp.station_mm *= factor;
    relief.taenia_turn /= factor;
    relief.length_mm = length_mm;
    return relief;
}

double foldDepth_mm(const Relief& relief, const std::vector<Fold>& near, const WallPlace& place)
{
    double depth = 0;
    for (const Fold& fold : near) {
        const double middle = relief.taeniaAngle(place.station_mm) + kHalfSector * (1 + 2 * fold.sector);
        const double off = wrapped(place.angle - middle);
        if (std::abs(off) >= kHalfSector)
            continue;
        const double crescent = std::pow(std::cos(1.5 * off), 0.7);
        double height = std::min(fold.depth_mm, kDeepest * place.radius_mm) * crescent;
        // Millimetres of wall per millimetre of station, where the fold is thinnest: at its foot or at its crest.
        const double at_foot = 1 - place.bend_per_mm * place.radius_mm;
        height *= std::clamp((at_foot - kMostCrowded) / (kUncrowded - kMostCrowded), 0.0, 1.0);
        const double spread = std::min(at_foot, 1 - place.bend_per_mm * (place.radius_mm - height));
        const double away_mm = place.station_mm - fold.station_mm - fold.slant_mm * std::pow(off / kHalfSector, 2);
        const double u = kHalfHeight * 2 / fold.thickness_mm * away_mm * std::max(spread, kMostCrowded);
        if (std::abs(u) < 1)
            depth = std::max(depth, height * std::sqrt(1 - std::pow(u, 6)));  // blunt: a sharp crest breaks into voxels
    }
    return depth;
}

double haustration(const Relief& relief, const std::vector<double>& rings_near, double station_mm, double angle)
{
    const double groove = std::pow(0.5 * (1 + std::cos(3 * (angle - relief.taeniaAngle(station_mm)))), 2);
    double constriction = 0;
    for (const double ring : rings_near) {
        const double d = (station_mm - ring) / kConstrictionReach;
        constriction = std::max(constriction, std::exp(-0.5 * d * d));
    }
    return 1 - kGroove * groove - kConstriction * constriction;
}

}  // namespace vicon::phantom

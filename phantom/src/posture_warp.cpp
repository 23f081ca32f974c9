#include "posture_warp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "random.h"

namespace vicon::phantom {
namespace {

constexpr double kLeastKnot_mm = 60, kMostKnot_mm = 200;

double interpolated(const std::vector<double>& values, double at)
{
    const double n = std::clamp(at, 0.0, double(values.size() - 1));
    const auto low = std::min(std::size_t(n), values.size() - 2);
    return std::lerp(values[low], values[low + 1], n - double(low));
}

}  // namespace

std::vector<double> halfLogStretch(std::uint64_t seed, Position position, double length_mm)
{
    const bool upright = position == Position::supine || position == Position::prone;
    const double sign = position == Position::supine || position == Position::left ? 1 : -1;
    Random random(seed, "stretch", upright ? 0 : 1);
    const auto knot = [&] { return random.uniform(std::log(kLeastStretch), std::log(kMostStretch)) / 2; };
    std::vector<double> field(std::size_t(length_mm) + 2);
    double from_mm = 0, to_mm = 0, from = 0, to = knot();
    for (std::size_t n = 0; n < field.size(); ++n) {
        while (double(n) >= to_mm) {
            from_mm = to_mm;
            from = to;
            to_mm += random.uniform(kLeastKnot_mm, kMostKnot_mm);
            to = knot();
        }
        const double part = (double(n) - from_mm) / (to_mm - from_mm);
        field[n] = sign * std::lerp(from, to, (1 - std::cos(std::numbers::pi * part)) / 2);
    }
    return field;
}

double PostureWarp::at(double wall_mm) const
{
    return interpolated(station_mm, wall_mm);
}

double PostureWarp::wallAt(double at_mm) const
{
    const auto above = std::upper_bound(station_mm.begin(), station_mm.end(), at_mm);
    if (above == station_mm.begin())
        return 0;
    if (above == station_mm.end())
        return double(station_mm.size() - 1);
    const auto n = std::size_t(above - station_mm.begin());
    return double(n - 1) + (at_mm - station_mm[n - 1]) / (station_mm[n] - station_mm[n - 1]);
}

PostureWarp freeWarp(const std::vector<double>& half_log_stretch)
{
    PostureWarp warp{{0}};
    for (std::size_t n = 0; n + 1 < half_log_stretch.size(); ++n)
        warp.station_mm.push_back(warp.station_mm.back() + std::exp(half_log_stretch[n]));
    return warp;
}

PostureWarp heldWarp(const std::vector<double>& half_log_stretch, const std::vector<double>& wall_mm,
                     const std::vector<double>& at_mm)
{
    const PostureWarp free = freeWarp(half_log_stretch);
    PostureWarp held;
    std::size_t part = 0;
    for (std::size_t n = 0; n < free.station_mm.size(); ++n) {
        while (part + 2 < wall_mm.size() && double(n) > wall_mm[part + 1])
            ++part;
        const double low = free.at(wall_mm[part]), high = free.at(wall_mm[part + 1]);
        const double share = std::clamp((free.station_mm[n] - low) / (high - low), 0.0, 1.0);
        held.station_mm.push_back(std::lerp(at_mm[part], at_mm[part + 1], share));
    }
    return held;
}

Relief warped(Relief relief, const PostureWarp& warp, double turn)
{
    for (double& ring : relief.ring_mm)
        ring = warp.at(ring);
    for (Fold& fold : relief.folds)
        fold.station_mm = warp.at(fold.station_mm);
    for (PolypSite& polyp : relief.polyps)
        polyp.station_mm = warp.at(polyp.station_mm);
    const double length_mm = warp.at(relief.length_mm);
    relief.taenia_turn *= relief.length_mm / length_mm;
    relief.taenia_phase += turn;
    relief.length_mm = length_mm;
    return relief;
}

}  // namespace vicon::phantom

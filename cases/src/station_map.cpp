#include "vicon/cases/station_map.h"

#include <algorithm>
#include <cmath>

namespace vicon {
namespace {

/// Interpolates `y` over ascending `x`; beyond the ends: the ends.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at)
{
    const auto above = std::upper_bound(x.begin(), x.end(), at);
    if (above == x.begin())
        return y.front();
    if (above == x.end())
        return y.back();
    const auto n = std::size_t(above - x.begin());
    return std::lerp(y[n - 1], y[n], (at - x[n - 1]) / (x[n] - x[n - 1]));
}

/// Curves that are turned round must rise.
void keepRising(std::vector<double>& values)
{
    constexpr double kLeast_mm = 1e-6;
    for (std::size_t n = 1; n < values.size(); ++n)
        values[n] = std::max(values[n], values[n - 1] + kLeast_mm);
}

}  // namespace

ColonProfile profileOf(const Skeleton& skeleton, const ColonPartRanges& parts, const LumenAlong& along)
{
    ColonProfile profile{skeleton.length_mm(), parts, {}, {}, {}};
    if (skeleton.empty())
        return profile;
    for (const SkeletonPiece& piece : skeleton.pieces)
        if (piece.bridge)
            profile.bridges.push_back({piece.points.front().station_mm, piece.points.back().station_mm});
    profile.bridges.insert(profile.bridges.end(), along.collapsed.begin(), along.collapsed.end());
    const auto count = std::size_t(profile.length_mm) + 1;
    for (std::size_t n = 0; n < count; ++n)
        profile.clearance_mm.push_back(skeleton.at(double(n)).radius_mm);
    if (along.step_mm > 0 && !along.radius_mm.empty())
        for (std::size_t n = 0; n < count; ++n) {
            const double at = std::clamp(double(n) / along.step_mm - 0.5, 0.0, double(along.radius_mm.size() - 1));
            const std::size_t low = std::size_t(at), high = std::min(low + 1, along.radius_mm.size() - 1);
            profile.width_mm.push_back(std::lerp(along.radius_mm[low], along.radius_mm[high], at - double(low)));
        }
    return profile;
}

std::string nameOf(MapSource source)
{
    switch (source) {
        case MapSource::wall:
            return "folds and width";
        case MapSource::landmarks:
            return "landmarks";
        case MapSource::fraction:
            break;
    }
    return "fraction of the length";
}

StationInterval StationMap::at(double station_mm) const
{
    if (from_mm.empty())
        return {};
    const auto above = std::upper_bound(from_mm.begin(), from_mm.end(), station_mm);
    if (above == from_mm.begin())
        return to.front();
    if (above == from_mm.end())
        return to.back();
    const auto n = std::size_t(above - from_mm.begin());
    const double part = (station_mm - from_mm[n - 1]) / (from_mm[n] - from_mm[n - 1]);
    const StationInterval &a = to[n - 1], &b = to[n];
    return {std::lerp(a.station_mm, b.station_mm, part), std::lerp(a.least_mm, b.least_mm, part),
            std::lerp(a.most_mm, b.most_mm, part)};
}

StationMap StationMap::reversed() const
{
    StationMap back{source, to_length_mm, from_length_mm, {}, {}};
    if (from_mm.empty())
        return back;
    std::vector<double> station, least, most;
    for (const StationInterval& interval : to) {
        station.push_back(interval.station_mm);
        least.push_back(interval.least_mm);
        most.push_back(interval.most_mm);
    }
    for (auto* curve : {&station, &least, &most})
        keepRising(*curve);
    const auto count = std::max<std::size_t>(2, std::size_t(to_length_mm / 10) + 1);
    for (std::size_t n = 0; n < count; ++n) {
        const double there = to_length_mm * double(n) / double(count - 1);
        back.from_mm.push_back(there);
        // What lies between the two curves lies between them seen from the other side, too.
        back.to.push_back({interpolated(station, from_mm, there), interpolated(most, from_mm, there),
                           interpolated(least, from_mm, there)});
    }
    return back;
}

}  // namespace vicon

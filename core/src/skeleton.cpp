#include "vicon/core/skeleton.h"

#include <algorithm>

#include "vicon/core/nearest_on_segment.h"

namespace vicon {
namespace {

const SkeletonPiece& pieceAt(const std::vector<SkeletonPiece>& pieces, double station_mm)
{
    for (const SkeletonPiece& piece : pieces)
        if (station_mm <= piece.points.back().station_mm)
            return piece;
    return pieces.back();
}

SkeletonPoint interpolate(const SkeletonPoint& a, const SkeletonPoint& b, double t)
{
    return {vicon::interpolate(a.position_mm, b.position_mm, t), std::lerp(a.station_mm, b.station_mm, t),
            std::lerp(a.radius_mm, b.radius_mm, t)};
}

}  // namespace

SkeletonPoint Skeleton::at(double station_mm) const
{
    const auto& points = pieceAt(pieces, station_mm).points;
    const auto after = std::lower_bound(points.begin(), points.end(), station_mm,
                                        [](const SkeletonPoint& p, double s) { return p.station_mm < s; });
    if (after == points.begin())
        return points.front();
    if (after == points.end())
        return points.back();
    const SkeletonPoint& a = *(after - 1);
    const double step = after->station_mm - a.station_mm;
    return step > 0 ? interpolate(a, *after, (station_mm - a.station_mm) / step) : *after;
}

Vector3 Skeleton::tangentAt(double station_mm, double window_mm) const
{
    const double s = std::clamp(station_mm, 0.0, length_mm());
    const double from = std::max(0.0, s - window_mm / 2), to = std::min(length_mm(), s + window_mm / 2);
    return normalized(at(to).position_mm - at(from).position_mm);
}

bool Skeleton::onBridge(double station_mm) const
{
    return pieceAt(pieces, station_mm).bridge;
}

SkeletonFoot Skeleton::nearest(Point3 p, double from_mm, double to_mm) const
{
    SkeletonFoot best;
    best.distance_mm = 1e300;
    for (const SkeletonPiece& piece : pieces)
        for (std::size_t n = 0; n + 1 < piece.points.size(); ++n) {
            const SkeletonPoint &a = piece.points[n], &b = piece.points[n + 1];
            if (b.station_mm < from_mm || a.station_mm > to_mm)
                continue;
            const SkeletonPoint foot = interpolate(a, b, nearestOnSegment(a.position_mm, b.position_mm, p));
            const double d = distance(foot.position_mm, p);
            if (d < best.distance_mm)
                best = {foot.station_mm, d, foot.position_mm, piece.bridge};
        }
    return best;
}

}  // namespace vicon

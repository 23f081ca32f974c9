#include "curve_errors.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vicon::test {

CurveErrors curveErrors(const Skeleton& found, const phantom::PhantomTruth& truth)
{
    Skeleton curve;
    curve.pieces.push_back({false, truth.curve});
    std::vector<double> away_mm;
    std::vector<double> stations;
    for (const SkeletonPiece& piece : found.pieces)
        for (const SkeletonPoint& p : piece.points) {
            const auto nearest = curve.nearest(p.position_mm);
            away_mm.push_back(nearest.distance_mm);
            stations.push_back(nearest.station_mm);
        }
    CurveErrors errors;
    if (away_mm.empty())
        return errors;
    std::sort(away_mm.begin(), away_mm.end());
    errors.mean_mm = 0;
    for (const double d : away_mm)
        errors.mean_mm += d / double(away_mm.size());
    errors.p95_mm = away_mm[away_mm.size() * 95 / 100];
    errors.length_fraction = found.length_mm() / truth.length_mm - 1;
    errors.directed = stations.front() < truth.length_mm * 0.02 && stations.back() > truth.length_mm * 0.98;
    for (std::size_t n = 0; n + 20 < stations.size(); ++n)
        errors.directed = errors.directed && stations[n + 20] > stations[n];
    return errors;
}

bool piecesInOrder(const Skeleton& found, const phantom::PhantomTruth& truth)
{
    Skeleton curve;
    curve.pieces.push_back({false, truth.curve});
    std::vector<std::pair<double, double>> bridges;
    for (const SkeletonPiece& piece : found.pieces)
        if (piece.bridge)
            bridges.emplace_back(curve.nearest(piece.points.front().position_mm).station_mm,
                                 curve.nearest(piece.points.back().position_mm).station_mm);
    if (bridges.size() != truth.gaps.size())
        return false;
    for (std::size_t n = 0; n < bridges.size(); ++n)
        if (bridges[n].first > truth.gaps[n].from_mm + 10 || bridges[n].second < truth.gaps[n].to_mm - 10 ||
            bridges[n].second - bridges[n].first > truth.gaps[n].to_mm - truth.gaps[n].from_mm + 30)
            return false;
    return true;
}

}  // namespace vicon::test

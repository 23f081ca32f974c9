#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "vicon/core/skeleton.h"
#include "vicon/phantom/phantom.h"

namespace vicon::steps::test {

/// How far a curve lies from the true one.
struct CurveErrors {
    double mean_mm = 0;
    double most_mm = 0;          ///< 95th percentile
    double worst_polyp_mm = 0;   ///< error of a polyp's station
    double length_fraction = 0;  ///< of the length, signed
};

inline CurveErrors curveErrors(const Skeleton& found, const phantom::PhantomTruth& truth)
{
    CurveErrors errors;
    Skeleton curve;
    curve.pieces.push_back({false, truth.curve});
    std::vector<double> away;
    for (const SkeletonPiece& piece : found.pieces)
        for (const SkeletonPoint& p : piece.points)
            away.push_back(curve.nearest(p.position_mm).distance_mm);
    std::sort(away.begin(), away.end());
    for (const double d : away)
        errors.mean_mm += d / double(away.size());
    errors.most_mm = away.empty() ? 1e9 : away[away.size() * 95 / 100];
    for (const phantom::Polyp& polyp : truth.polyps)
        errors.worst_polyp_mm =
            std::max(errors.worst_polyp_mm, std::abs(found.nearest(polyp.position_mm).station_mm - polyp.station_mm));
    errors.length_fraction = found.length_mm() / truth.length_mm - 1;
    return errors;
}

}  // namespace vicon::steps::test

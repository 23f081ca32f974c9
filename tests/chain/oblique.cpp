#include "oblique.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "chain.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"

namespace vicon::test {
namespace {

struct Found {
    InsideVolume inside;
    Skeleton curve;
    InsideVolume truth;
};

Found acquire(phantom::PhantomOptions options, const std::string& position, double degrees)
{
    NoProgress quiet;
    options.oblique_deg = degrees;
    phantom::PhantomScan scan = phantom::makeScan(options, position, quiet);
    const HuVolume volume = steps::resample(std::move(scan.hu), {}, quiet);
    steps::Segmentation lumen = steps::segmentColon(volume, scan.truth.gravity, {}, quiet);
    Skeleton curve = steps::findSkeleton(lumen.inside, lumen.plan, {}, quiet).curve;
    return {std::move(lumen.inside), std::move(curve), std::move(scan.truth.inside)};
}

/// Whether a point lies in the lumen, between voxels by linear interpolation of the labels.
bool insideAt(const InsideVolume& volume, Point3 p)
{
    const ContinuousIndex3 c = volume.grid.continuousIndexAt(p);
    const Index3 base{int(std::floor(c.i)), int(std::floor(c.j)), int(std::floor(c.k))};
    const double f[3] = {c.i - base.i, c.j - base.j, c.k - base.k};
    double part = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
        if (volume.valueOr({base.i + di, base.j + dj, base.k + dk}, kOutside) != kOutside)
            part += (di ? f[0] : 1 - f[0]) * (dj ? f[1] : 1 - f[1]) * (dk ? f[2] : 1 - f[2]);
    }
    return part >= 0.5;
}

/// Dice of two masks on grids of their own, on the voxels of the first and on those of the second together.
double diceBetween(const InsideVolume& a, const InsideVolume& b)
{
    double both = 0, all = 0;
    const auto add = [&](const InsideVolume& here, const InsideVolume& there) {
        for (std::size_t n = 0; n < here.voxels.size(); ++n) {
            const bool in_here = here.voxels[n] != kOutside;
            all += in_here;
            both += in_here && insideAt(there, here.grid.pointAt(here.grid.indexOf(n)));
        }
    };
    add(a, b);
    add(b, a);
    return both / all;
}

}  // namespace

Difference obliqueDifference(const phantom::PhantomOptions& options, const std::string& position, double degrees)
{
    const Found straight = acquire(options, position, 0), oblique = acquire(options, position, degrees);
    Difference difference;
    difference.dice = diceBetween(straight.inside, oblique.inside);
    difference.truth_dice = diceBetween(straight.truth, oblique.truth);
    difference.straight_dice = diceBetween(straight.inside, straight.truth);
    difference.oblique_dice = diceBetween(oblique.inside, oblique.truth);
    std::vector<double> away_mm;
    for (const auto& [from, to] : {std::pair{&straight, &oblique}, std::pair{&oblique, &straight}})
        for (const SkeletonPiece& piece : from->curve.pieces)
            for (const SkeletonPoint& p : piece.points)
                away_mm.push_back(to->curve.nearest(p.position_mm).distance_mm);
    std::sort(away_mm.begin(), away_mm.end());
    for (const double d : away_mm)
        difference.curve_mean_mm += d / double(away_mm.size());
    difference.curve_most_mm = away_mm.empty() ? 1e9 : away_mm[away_mm.size() * 95 / 100];
    difference.length_fraction = oblique.curve.length_mm() / straight.curve.length_mm() - 1;
    return difference;
}

}  // namespace vicon::test

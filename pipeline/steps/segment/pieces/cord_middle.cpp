#include "segment/pieces/cord_middle.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "grid/voxel_box.h"
#include "segment/constants.h"
#include "skeleton/section.h"
#include "skeleton/section_fit.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 302, 304 and 305, full size.
constexpr double kCordMargin_mm = 20;  // of the box around the line
constexpr double kCordReach_mm = 15;   // wall farther away is not the cord's
constexpr int kRays = 48;
constexpr double kStretch_mm = 10;  // of the line on either side, fading outwards, for the fit
constexpr int kRounds = 6;
constexpr double kCordSmoothing_mm = 4;  // of the line after each round
constexpr double kLeastSeen = 0.5;       // of the rays that must end in fat
constexpr double kMostIrregular = 0.25;  // spread of the wall about the fit, in radii
constexpr double kMostMoved_mm = 3;      // in a round

/// What lies around the line, bowel and lumen as one, noise averaged out. The lumen and the blurred rim around it count
/// as the bowel's wall.
InsideVolume bowelAround(const HuVolume& volume, const InsideVolume& inside, const WallDensities& densities,
                         const Polyline& line)
{
    std::array<int, 3> first, end;
    for (std::size_t n = 0; n < 3; ++n) {
        double low = 1e300, high = -1e300;
        for (const Point3 p : line) {
            const ContinuousIndex3 c = volume.grid.continuousIndexAt(p);
            const double at = n == 0 ? c.i : n == 1 ? c.j : c.k;
            low = std::min(low, at);
            high = std::max(high, at);
        }
        const double margin = kCordMargin_mm / volume.grid.spacing_mm[n];
        first[n] = std::clamp(int(low - margin), 0, volume.grid.size[n] - 1);
        end[n] = std::clamp(int(high + margin), first[n], volume.grid.size[n] - 1) + 1;
    }
    const Grid grid = cropped(volume.grid, {{first[0], first[1], first[2]}, {end[0], end[1], end[2]}});
    Volume<float> density(grid, 0);
    const Index3 off = inside.grid.indexAt(grid.origin_mm);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) {
                bool lumen = false;
                for (int d = 0; d < 27 && !lumen; ++d)
                    lumen = inside.valueOr({off.i + i + d % 3 - 1, off.j + j + d / 3 % 3 - 1, off.k + k + d / 9 - 1},
                                           kOutside) != kOutside;
                density.at({i, j, k}) =
                    lumen ? float(densities.tissue_hu) : float(volume.at({first[0] + i, first[1] + j, first[2] + k}));
            }
    });
    InsideVolume bowel(grid);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i) {
                double sum = 0;
                for (int d = 0; d < 27; ++d)
                    sum += density.valueOr({i + d % 3 - 1, j + d / 3 % 3 - 1, k + d / 9 - 1}, float(kAir_hu));
                bowel.at({i, j, k}) = sum > 27 * softFrom_hu(densities) ? kGas : kOutside;
            }
    });
    return bowel;
}

/// The line once moved to the middle of what is around it.
Polyline moved(const Polyline& line, const DistanceProbe& bowel)
{
    const auto frames = framesAlong(line, 4);
    std::vector<std::vector<float>> radii_mm(line.size(), std::vector<float>(kRays)), seen = radii_mm;
    tbb::parallel_for(std::size_t(0), line.size(), [&](std::size_t n) {
        for (int r = 0; r < kRays; ++r) {
            const double angle = 2 * std::numbers::pi * r / kRays;
            const double d =
                reach(bowel, line[n], frames[n].u * std::cos(angle) + frames[n].v * std::sin(angle), kCordReach_mm);
            radii_mm[n][std::size_t(r)] = float(d);
            seen[n][std::size_t(r)] = d > 0 && d < kCordReach_mm ? 1 : 0;
        }
    });
    Polyline out = line;
    tbb::parallel_for(std::size_t(0), line.size(), [&](std::size_t n) {
        const auto half = std::size_t(kStretch_mm);
        const std::size_t from = n > half ? n - half : 0, to = std::min(line.size() - 1, n + half);
        std::vector<WallRing> wall;
        double count = 0;
        for (std::size_t m = from; m <= to; ++m) {
            wall.push_back({(double(m) - double(n)) / kStretch_mm, radii_mm[m], seen[m]});
            count += std::accumulate(seen[m].begin(), seen[m].end(), 0.0);
        }
        if (count < kLeastSeen * double(to - from + 1) * kRays)
            return;
        const SectionFit fit = fitSection(wall);
        if (fit.spread_mm > kMostIrregular * fit.radius_mm)
            return;
        Vector3 shift = frames[n].u * fit.middle_mm[0] + frames[n].v * fit.middle_mm[1];
        if (const double far = length(shift); far > kMostMoved_mm)
            shift = shift * (kMostMoved_mm / far);
        out[n] = keptInside(line[n] + shift, line[n], bowel);
    });
    return out;
}

}  // namespace

Polyline middleOfCord(const HuVolume& volume, const InsideVolume& inside, const WallDensities& densities,
                      const Polyline& line, Progress& progress)
{
    const FieldVolume distance_mm = wallDistance(bowelAround(volume, inside, densities, line), progress);
    const DistanceProbe bowel(distance_mm);
    Polyline out = line;
    for (int n = 0; n < kRounds; ++n)
        out = resampled(smoothed(moved(out, bowel), kCordSmoothing_mm, 1), 1);
    return out;
}

}  // namespace vicon::steps

#include "tissue/edge_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grid/allocate.h"
#include "grid/byte_rows.h"
#include "tissue/near_mask.h"

namespace vicon::steps {
namespace {

// Held by tissue_test: edges of gas, fluid and both, at a blur of 0.7 mm. Half of
// kNoWallSlope and double of kWallSlope, which then change places, move the wall of ctc-prone by 0.1 mm in the mean and
// that of phantom 215 by 0.015 mm; half and double of the others by 0.0002 mm or less.

/// How far around the lumen the fraction is sought.
constexpr double kAround_mm = 5;
/// A voxel this far from fluid, along each axis, holds some of it: three sigma of the point spread.
constexpr int kFluidReach_voxels = 3;
/// Below this fraction nothing need be asked.
constexpr double kSome = 0.1;
/// The slope as a part of that between gas and fluid without a wall: a wall of 1.5 mm has at most 0.6 of it at a blur
/// of 0.7 mm, and one of 0.8 mm 0.85.
constexpr double kWallSlope = 0.75, kNoWallSlope = 0.95;
/// Where the density does not rise by this part of its slope along gravity, fluid is not held by what lies under it,
/// but by a wall, however thin.
constexpr double kLeastDownwards = 0.3;
/// On both sides of such an edge lies, this far along its slope, what the labels say.
constexpr double kAcross_voxels = 2.5;

class Edges {
public:
    Edges(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down, double blur_voxels)
        : mixture_(mixture),
          fluid_(fluid),
          down_(normalized(down.per_voxel)),
          peak_per_hu_(1 / std::sqrt(2 * std::numbers::pi * (blur_voxels * blur_voxels + 1.0 / 3)))
    {
    }

    double fraction(Index3 v, double hu, bool near_fluid) const
    {
        if (!near_fluid)
            return hu > mixture_.tissue_hu ? 1 : mixture_.fraction(hu, mixture_.gas_hu);
        const double fluid_hu = fluid_.besides(v);
        double s = hu <= mixture_.tissue_hu ? mixture_.fraction(hu, mixture_.gas_hu)
                   : fluid_hu > 0           ? mixture_.fraction(hu, fluid_hu)
                                            : 1;
        s = std::clamp(s, 0.0, 1.0);
        if (s > kSome && fluid_hu > 0 && mixture_.inside.at(v) != kOutside)
            s *= std::clamp((kNoWallSlope - slopeOfStep(v, hu, fluid_hu)) / (kNoWallSlope - kWallSlope), 0.0, 1.0);
        return s;
    }

private:
    /// The density's slope as a part of what a blurred step from gas to fluid has at this density (a parabola, off by
    /// at most 8 % of its peak); 0 where the labels show no such step.
    double slopeOfStep(Index3 v, double hu, double fluid_hu) const
    {
        const auto along = [&](int di, int dj, int dk) {
            return (mixture_.hu({v.i + di, v.j + dj, v.k + dk}) - mixture_.hu({v.i - di, v.j - dj, v.k - dk})) / 2.0;
        };
        const Vector3 slope{along(1, 0, 0), along(0, 1, 0), along(0, 0, 1)};
        const double t = (hu - mixture_.gas_hu) / (fluid_hu - mixture_.gas_hu);
        const double steepest = (fluid_hu - mixture_.gas_hu) * peak_per_hu_ * 4 * t * (1 - t);
        if (t <= 0 || t >= 1 || length(slope) < kWallSlope * steepest ||
            dot(slope, down_) < kLeastDownwards * length(slope))
            return 0;
        const Vector3 across = normalized(slope) * kAcross_voxels;
        const auto labelAt = [&](double sign) {
            return mixture_.inside.valueOr(
                {v.i + int(std::lround(sign * across.x)), v.j + int(std::lround(sign * across.y)),
                 v.k + int(std::lround(sign * across.z))},
                kOutside);
        };
        return labelAt(-1) == kGas && labelAt(1) == kFluid ? length(slope) / steepest : 0;
    }

    const Mixture& mixture_;
    const FluidDensity& fluid_;
    Vector3 down_;        ///< along gravity, in voxels
    double peak_per_hu_;  ///< of a central difference, per HU of the step
};

}  // namespace

TissueVolume fractionAtEdges(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down,
                             double blur_voxels)
{
    const InsideVolume& inside = mixture.inside;
    const auto [nx, ny, nz] = inside.grid.size;
    auto tissue = makeVolume<std::uint8_t>(inside.grid, std::uint8_t(kWhole));
    const auto around = nearMask(inside, kOutside, int(std::lround(kAround_mm / inside.grid.spacing_mm[0])));
    const auto near_fluid = nearMask(inside, kFluid, kFluidReach_voxels);
    const Edges edges(mixture, fluid, down, blur_voxels);
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        for (int j = 0; j < ny; ++j) {
            const std::size_t begin = inside.grid.offset({0, j, k});
            const std::uint8_t* row = &around[begin];
            for (int i = firstOther(row, 0, nx, 0); i < nx; i = firstOther(row, i + 1, nx, 0)) {
                const std::size_t n = begin + std::size_t(i);
                tissue.voxels[n] = stored(edges.fraction({i, j, k}, mixture.hu({i, j, k}), near_fluid[n] != 0));
            }
        }
    });
    return tissue;
}

}  // namespace vicon::steps

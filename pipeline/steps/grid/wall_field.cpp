#include "grid/wall_field.h"

#include <algorithm>
#include <cmath>

#include "grid/byte_rows.h"
#include "grid/lattice.h"
#include "grid/neighbours.h"

namespace vicon::steps {
namespace {

/// A pool's density must differ from tissue by this much to place a wall; less is taken as this. No case recorded;
/// half and double leave the three cases (CONTRIBUTING.md) as they are.
constexpr double kLeastContrast_hu = 50;

}  // namespace

RowsNearLumen::RowsNearLumen(const InsideVolume& inside)
    : rows_(inside.grid.size[1] + 2), near_(std::size_t(rows_) * std::size_t(inside.grid.size[2] + 2), 0)
{
    const auto [nx, ny, nz] = inside.grid.size;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j) {
            const std::uint8_t* row = &inside.voxels[inside.grid.offset({0, j, k})];
            if (firstOther(row, 0, nx, kOutside) == nx)
                continue;
            for (int dk = -1; dk <= 1; ++dk)
                for (int dj = -1; dj <= 1; ++dj)
                    near_[index(j + dj, k + dk)] = 1;
        }
}

WallField::WallField(const HuVolume& hu, const InsideVolume& inside, const WallDensities& densities)
    : hu_(hu),
      inside_(inside),
      densities_(densities),
      offset_(latticeOffset(inside.grid, hu.grid)),
      pools_(inside, kFluid),
      meniscus_(inside)
{
    measurePools();
}

/// A pool's density is the median over its voxels that have only fluid around them, or over all where there are none.
void WallField::measurePools()
{
    std::vector<std::vector<std::int16_t>> deep(pools_.count()), all(pools_.count());
    for (const Run& run : pools_.runs())
        for (int i = run.begin; i < run.end; ++i) {
            const Index3 v{i, run.j, run.k};
            const auto density = std::int16_t(hu(v, densities_.tissue_hu));
            all[run.component].push_back(density);
            const bool surrounded = std::all_of(kFaces.begin(), kFaces.end(), [&](Index3 face) {
                return inside_.valueOr(shifted(v, face), kOutside) == kFluid;
            });
            if (surrounded)
                deep[run.component].push_back(density);
        }
    for (std::size_t n = 0; n < all.size(); ++n) {
        auto& values = deep[n].empty() ? all[n] : deep[n];
        constexpr std::size_t kOneSigma_percent = 84;  // of a normal distribution
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        pool_hu_.push_back(*middle);
        const auto above = values.begin() + std::ptrdiff_t(values.size() * kOneSigma_percent / 100);
        std::nth_element(middle, above, values.end());
        pool_noise_hu_.push_back(*above - pool_hu_.back());
    }
}

double WallField::hu(Index3 v, double otherwise) const
{
    const std::int16_t value = hu_.valueOr({v.i + offset_.i, v.j + offset_.j, v.k + offset_.k}, kPaddingHu);
    return value == kPaddingHu ? otherwise : double(value);
}

Vector3 WallField::gradient(Index3 v) const
{
    const double here = hu(v, densities_.tissue_hu);
    const auto along = [&](int di, int dj, int dk) {
        return 0.5 * (hu({v.i + di, v.j + dj, v.k + dk}, here) - hu({v.i - di, v.j - dj, v.k - dk}, here));
    };
    return {along(1, 0, 0), along(0, 1, 0), along(0, 0, 1)};
}

double WallField::valueBeside(Index3 labelled, std::uint8_t label, double density) const
{
    if (label == kGas)
        return (density - densities_.wall_hu) / (densities_.tissue_hu - densities_.wall_hu);
    const double contrast = std::max(pool_hu_[pools_.at(labelled)] - densities_.tissue_hu, kLeastContrast_hu);
    return (densities_.tissue_hu + contrast / 2 - density) / (contrast / 2);
}

/// The value that the densities tell, whichever voxel it is.
float WallField::fromDensities(Index3 v) const
{
    if (const std::uint8_t own = inside_.valueOr(v, kOutside)) {
        double density = hu(v, own == kGas ? kUsualAir_hu : pool_hu_[pools_.at(v)]);
        if (own == kFluid && besideThinFold(v))
            density = asThickFold(v, v, density);
        return std::clamp(float(valueBeside(v, own, density)), -1.0F, -kLeast);
    }
    double sum = 0;
    int count = 0;
    const double density = hu(v, densities_.tissue_hu);
    for (const Index3 face : kFaces) {
        const Index3 n = shifted(v, face);
        if (const std::uint8_t label = inside_.valueOr(n, kOutside)) {
            sum += valueBeside(n, label, label == kFluid ? asThickFold(v, n, density) : density);
            ++count;
        }
    }
    return count == 0 ? 1.0F : std::clamp(float(sum / count), kLeast, 1.0F);
}

/// Whether fluid lies beside a voxel of wall that is brighter than half-way.
bool WallField::besideThinFold(Index3 fluid) const
{
    const double half_hu = (densities_.tissue_hu + pool_hu_[pools_.at(fluid)]) / 2;
    return std::any_of(kFaces.begin(), kFaces.end(), [&](Index3 face) {
        const Index3 n = shifted(fluid, face);
        return inside_.valueOr(n, kOutside) == kOutside && hu(n, densities_.tissue_hu) > half_hu;
    });
}

/// A wall so thin that blur lifts its densities above half-way: as much lower as its bottom is above tissue, in
/// proportion, so that its surface too lies half-way between bottom and fluid.
double WallField::asThickFold(Index3 v, Index3 fluid, double density) const
{
    const double fluid_hu = pool_hu_[pools_.at(fluid)];
    if (density <= (densities_.tissue_hu + fluid_hu) / 2)
        return density;
    double bottom = density;
    forEachInCube(v, kFoldBottom_voxels, [&](Index3 n) { bottom = std::min(bottom, hu(n, density)); });
    return density - (std::max(bottom, densities_.tissue_hu) - densities_.tissue_hu) / 2;
}

/// The binomial mean around a voxel where gas, fluid and wall meet: of the mask there, of the densities' values beyond.
float WallField::smoothed(Index3 v) const
{
    float sum = 0;
    for (int k = -2; k <= 2; ++k)
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i) {
                const Index3 n{v.i + i, v.j + j, v.k + k};
                const float mask = inside_.valueOr(n, kOutside) != kOutside ? -1.0F : 1.0F;
                const float value = meniscus_.near(n) ? mask : fromDensities(n);
                sum += value * float(binomial(i) * binomial(j) * binomial(k));
            }
    return sum / float(kBinomialSum);
}

float WallField::ofInside(Index3 v) const
{
    return meniscus_.near(v) ? std::clamp(smoothed(v), -1.0F, -kLeast) : fromDensities(v);
}

float WallField::ofOutside(Index3 v) const
{
    return meniscus_.near(v) ? std::clamp(smoothed(v), kLeast, 1.0F) : fromDensities(v);
}

}  // namespace vicon::steps

#include "tissue/fluid_density.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "grid/neighbours.h"

namespace vicon::steps {
namespace {

/// A block's edge: half of the distance over which the density of a pool changes.
constexpr int kBlock_voxels = 4;
/// Blur reaches this far into fluid from gas and tissue: three sigma of the point spread.
constexpr int kDeep_voxels = 3;
/// Passes of the mean over neighbouring blocks, and how many blocks beyond the fluid its density is known.
constexpr int kSmoothing = 2, kBeyond = 2;
/// Fluid that differs by this much counts for a third: another pool behind a wall (ctc-prone: 750 HU in the caecum,
/// 500 HU in the bowel that touches it). Within a pool the density changes by less over a block.
constexpr double kOtherPool_hu = 100;
/// Contrast medium settles on the floor of a pool, in layers thinner than a block (ctc-prone, caecum: 700 HU, over the
/// last 5 mm rising to 1500). A fold that stands in it is thinner than this from its middle to what lies on both sides.
constexpr int kBesides_voxels = 4;
/// Of this fraction of tissue a dip between sediment and thinner fluid is sure to be one. The fold that parts them is
/// so thin (ctc-prone, caecum: 1400 and 850 HU, between them 720) that what it is mixed with is half of each.
constexpr double kSureDip = 0.1;
/// Kernels that enhance edges overshoot by so much of the density; noise by so many of its deviations.
/// What lies below its neighbours by noise alone is no dip.
constexpr double kOvershoot = 0.1, kNoises = 4, kNoisesOfADip = 2;

bool isDeep(const InsideVolume& inside, Index3 v)
{
    return std::all_of(kFaces.begin(), kFaces.end(), [&](Index3 face) {
        return inside.valueOr({v.i + kDeep_voxels * face.i, v.j + kDeep_voxels * face.j, v.k + kDeep_voxels * face.k},
                              kOutside) == kFluid;
    });
}

/// The densities that fluid reaches on both sides of a voxel along an axis.
struct Sides {
    double fainter_hu = 0, denser_hu = 0;
};

Sides sidesOf(const Mixture& mixture, Index3 v, Index3 axis)
{
    std::array<double, 2> side_hu{};
    for (int n = 1; n <= kBesides_voxels; ++n)
        for (const int sign : {0, 1}) {
            const int m = sign ? n : -n;
            double& hu = side_hu[std::size_t(sign)];
            hu = std::max(hu, double(mixture.hu({v.i + m * axis.i, v.j + m * axis.j, v.k + m * axis.k})));
        }
    return {std::min(side_hu[0], side_hu[1]), std::max(side_hu[0], side_hu[1])};
}

/// Along the axis where both sides reach the highest density.
Sides densestSides(const Mixture& mixture, Index3 v)
{
    Sides densest;
    for (const Index3 axis : {Index3{1, 0, 0}, Index3{0, 1, 0}, Index3{0, 0, 1}})
        if (const Sides sides = sidesOf(mixture, v, axis); sides.fainter_hu > densest.fainter_hu)
            densest = sides;
    return densest;
}

struct Sums {
    double deep = 0, brightest = 0;
    int count = 0;
    bool fluid = false;
};

/// Sums over the fluid of a block: that of pure fluid where it has some.
/// @param margin_hu where both sides are denser by more, a fold is in the voxel that was too faint to be no fluid
Sums sumsOf(const Mixture& mixture, Index3 first, double margin_hu)
{
    Sums sums;
    const Grid& grid = mixture.inside.grid;
    const auto forEachFluid = [&](auto use) {
        for (int k = first.k; k < std::min(grid.size[2], first.k + kBlock_voxels); ++k)
            for (int j = first.j; j < std::min(grid.size[1], first.j + kBlock_voxels); ++j)
                for (int i = first.i; i < std::min(grid.size[0], first.i + kBlock_voxels); ++i)
                    if (const Index3 v{i, j, k}; mixture.inside.at(v) == kFluid)
                        use(v, double(mixture.hu(v)));
    };
    forEachFluid([&](Index3, double hu) {
        sums.fluid = true;
        sums.brightest = std::max(sums.brightest, hu);
    });
    forEachFluid([&](Index3 v, double hu) {
        if (!isDeep(mixture.inside, v))
            return;
        if (hu + margin_hu < sums.brightest && hu + margin_hu < densestSides(mixture, v).fainter_hu)
            return;
        sums.deep += hu;
        ++sums.count;
    });
    return sums;
}

/// Whether a row of blocks holds any fluid.
bool holdsFluid(const InsideVolume& inside, int block_j, int block_k)
{
    const auto [nx, ny, nz] = inside.grid.size;
    for (int k = block_k * kBlock_voxels; k < std::min(nz, (block_k + 1) * kBlock_voxels); ++k)
        for (int j = block_j * kBlock_voxels; j < std::min(ny, (block_j + 1) * kBlock_voxels); ++j)
            if (std::memchr(&inside.at({0, j, k}), kFluid, std::size_t(nx)))
                return true;
    return false;
}

/// The sums over a value and its two neighbours along one axis of a box.
void addNeighbours(std::vector<float>& values, const std::array<int, 3>& size, std::size_t axis)
{
    std::size_t stride = 1;
    for (std::size_t a = 0; a < axis; ++a)
        stride *= std::size_t(size[a]);
    const auto length = std::size_t(size[axis]);
    const std::size_t lines = values.size() / length;
    tbb::parallel_for(std::size_t(0), lines, [&](std::size_t line) {
        const std::size_t begin = line / stride * stride * length + line % stride;
        float before = 0;
        for (std::size_t n = 0; n < length; ++n) {
            float& here = values[begin + n * stride];
            const float own = here, after = n + 1 < length ? values[begin + (n + 1) * stride] : 0.0F;
            here = before + own + after;
            before = own;
        }
    });
}

}  // namespace

FluidDensity::FluidDensity(const Mixture& mixture, double noise_hu, double tag_contrast_hu)
    : mixture_(mixture), noise_hu_(noise_hu), least_hu_(mixture.tissue_hu + tag_contrast_hu)
{
    const Grid& grid = mixture.inside.grid;
    for (std::size_t d = 0; d < 3; ++d)
        size_[d] = (grid.size[d] + kBlock_voxels - 1) / kBlock_voxels;
    sum_.assign(std::size_t(size_[0]) * std::size_t(size_[1]) * std::size_t(size_[2]), 0.0F);
    weight_ = sum_;
    brightest_ = sum_;
    tbb::parallel_for(0, size_[2], [&](int k) {
        for (int j = 0; j < size_[1]; ++j) {
            if (!holdsFluid(mixture.inside, j, k))
                continue;
            for (int i = 0; i < size_[0]; ++i) {
                const Sums sums =
                    sumsOf(mixture, {i * kBlock_voxels, j * kBlock_voxels, k * kBlock_voxels}, kNoises * noise_hu_);
                const std::size_t n = index(i, j, k);
                sum_[n] = float(sums.deep);
                weight_[n] = float(sums.count);
                brightest_[n] = sums.fluid && sums.brightest > least_hu_ ? float(sums.brightest) : 0.0F;
            }
        }
    });
    const auto isSome = [](float value) { return value > 0; };
    if (std::none_of(weight_.begin(), weight_.end(), isSome) &&
        std::none_of(brightest_.begin(), brightest_.end(), isSome))
        return;
    smooth();
    // A pool that is nowhere deep: the brightest of it is the least diluted.
    for (std::size_t n = 0; n < sum_.size(); ++n)
        if (weight_[n] <= 0 && brightest_[n] > 0) {
            sum_[n] = brightest_[n];
            weight_[n] = 1;
        }
    for (int n = 0; n < kBeyond; ++n)
        spread();
    for (std::size_t n = 0; n < sum_.size(); ++n)
        if (weight_[n] > 0)
            sum_[n] /= weight_[n];
    for (float& weight : weight_)
        weight = weight > 0 ? 1.0F : 0.0F;
    spreadBrightest();
}

/// Each block takes the mean of those around it that may be of the same pool.
void FluidDensity::smooth()
{
    for (int pass = 0; pass < kSmoothing; ++pass) {
        const std::vector<float> sum = sum_, weight = weight_;
        const auto isKnown = [&](int j, int k) {
            const auto first = weight.begin() + std::ptrdiff_t(index(0, j, k));
            return std::any_of(first, first + size_[0], [](float value) { return value > 0; });
        };
        std::vector<std::uint8_t> known(std::size_t(size_[1]) * std::size_t(size_[2]));
        const auto row = [&](int j, int k) { return std::size_t(j) + std::size_t(size_[1]) * std::size_t(k); };
        tbb::parallel_for(0, size_[2], [&](int k) {
            for (int j = 0; j < size_[1]; ++j)
                known[row(j, k)] = isKnown(j, k) ? 1 : 0;
        });
        const auto isKnownBeside = [&](int j, int k) {
            for (int b = std::max(0, k - 1); b <= std::min(size_[2] - 1, k + 1); ++b)
                for (int a = std::max(0, j - 1); a <= std::min(size_[1] - 1, j + 1); ++a)
                    if (known[row(a, b)])
                        return true;
            return false;
        };
        tbb::parallel_for(0, size_[2], [&](int k) {
            for (int j = 0; j < size_[1]; ++j)
                if (isKnownBeside(j, k))
                    for (int i = 0; i < size_[0]; ++i)
                        smoothBlock({i, j, k}, sum, weight);
        });
    }
}

void FluidDensity::smoothBlock(Index3 block, const std::vector<float>& sum, const std::vector<float>& weight)
{
    const std::size_t own = index(block.i, block.j, block.k);
    const float own_hu = weight[own] > 0 ? sum[own] / weight[own] : 0;
    float sums = 0, weights = 0;
    for (int k = std::max(0, block.k - 1); k <= std::min(size_[2] - 1, block.k + 1); ++k)
        for (int j = std::max(0, block.j - 1); j <= std::min(size_[1] - 1, block.j + 1); ++j)
            for (int i = std::max(0, block.i - 1); i <= std::min(size_[0] - 1, block.i + 1); ++i) {
                const std::size_t n = index(i, j, k);
                if (weight[n] <= 0)
                    continue;
                const float off = own_hu > 0 ? (sum[n] / weight[n] - own_hu) / float(kOtherPool_hu) : 0;
                const float likeness = std::exp(-off * off);
                sums += likeness * sum[n];
                weights += likeness * weight[n];
            }
    sum_[own] = sums;
    weight_[own] = weights;
}

/// Blocks without a density take the mean of those beside them.
void FluidDensity::spread()
{
    std::vector<float> sum = sum_, weight = weight_;
    for (std::size_t n = 0; n < sum.size(); ++n)
        if (weight[n] > 0) {
            sum[n] /= weight[n];
            weight[n] = 1;
        }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        addNeighbours(sum, size_, axis);
        addNeighbours(weight, size_, axis);
    }
    for (std::size_t n = 0; n < sum.size(); ++n)
        if (weight_[n] <= 0 && weight[n] > 0) {
            sum_[n] = sum[n] / weight[n];
            weight_[n] = 1;
        }
}

double FluidDensity::at(Index3 v) const
{
    // Between the middles of the blocks, over those where it is known.
    std::array<int, 3> low{};
    std::array<float, 3> part{};
    const std::array<int, 3> at{v.i, v.j, v.k};
    for (std::size_t d = 0; d < 3; ++d) {
        const float place = (float(at[d]) + 0.5F) / kBlock_voxels - 0.5F;
        low[d] = int(std::floor(place));
        part[d] = place - float(low[d]);
    }
    float sum = 0, weight = 0;
    for (int n = 0; n < 8; ++n) {
        std::array<int, 3> block{};
        float share = 1;
        bool within = true;
        for (std::size_t d = 0; d < 3; ++d) {
            const int high = n >> d & 1;
            block[d] = low[d] + high;
            share *= high ? part[d] : 1 - part[d];
            within = within && block[d] >= 0 && block[d] < size_[d];
        }
        if (!within)
            continue;
        const std::size_t m = index(block[0], block[1], block[2]);
        sum += share * weight_[m] * sum_[m];
        weight += share * weight_[m];
    }
    const double hu = weight > 0 ? double(sum / weight) : 0.0;
    return hu < least_hu_ ? 0 : hu;
}

/// Of each block and those around it.
void FluidDensity::spreadBrightest()
{
    std::vector<float> own = brightest_;
    std::size_t stride = 1;
    for (const int length : size_) {
        for (std::size_t n = 0; n < own.size(); ++n) {
            const auto at = int(n / stride % std::size_t(length));
            brightest_[n] = std::max({own[n], at > 0 ? own[n - stride] : 0, at + 1 < length ? own[n + stride] : 0});
        }
        own = brightest_;
        stride *= std::size_t(length);
    }
}

double FluidDensity::besides(Index3 v) const
{
    const double pool_hu = at(v);
    if (pool_hu <= 0)
        return 0;
    const double margin_hu = kOvershoot * pool_hu + kNoises * noise_hu_;
    const double brightest_hu = brightest_[index(v.i / kBlock_voxels, v.j / kBlock_voxels, v.k / kBlock_voxels)];
    if (brightest_hu <= pool_hu + margin_hu)
        return pool_hu;
    const Sides sides = densestSides(mixture_, v);
    const double fluid_hu = std::max(pool_hu, sides.fainter_hu - margin_hu);
    const double both_hu = std::max(fluid_hu, (sides.fainter_hu + sides.denser_hu - margin_hu) / 2);
    // Between blocks the density is that of neither: what counts is how far the voxel lies below its fainter side. A
    // thick wall keeps its flanks: the fainter side's is where that side ends.
    const double side_hu = std::min(fluid_hu, sides.fainter_hu - kNoisesOfADip * noise_hu_);
    const double fraction = side_hu > least_hu_ ? std::clamp(mixture_.fraction(mixture_.hu(v), side_hu), 0.0, 1.0) : 0;
    const double thinness = std::min(1.0, fraction / kSureDip) * (1 - fraction) * (1 - fraction);
    return fluid_hu + thinness * (both_hu - fluid_hu);
}

}  // namespace vicon::steps

#include "tissue/smooth_along_wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

/// The wall's blurred edge, as fractions.
constexpr double kFrom = 0.08, kTo = 0.92;
/// Differences this many times the noise count for exp(-1/2); at least kLeastRange, what a usual edge falls along a
/// bend.
constexpr double kRange_noises = 3, kLeastRange = 0.06;
/// Two means over 3 x 3 x 3 voxels take off three quarters of a ripple of four voxels, 2.7 mm.
constexpr int kPasses = 2;

/// Weights by the difference of two stored fractions.
std::array<float, 256> weightsFor(double noise)
{
    const double range = kWhole * std::max(kRange_noises * noise, kLeastRange);
    std::array<float, 256> weights{};
    for (std::size_t n = 0; n < weights.size(); ++n)
        weights[n] = float(std::exp(-0.5 * double(n * n) / (range * range)));
    return weights;
}

class Smoothing {
public:
    Smoothing(double noise, const TissueVolume& tissue)
        : tissue_(tissue), weights_(weightsFor(noise)), row_(tissue.grid.size[0]), slice_(row_ * tissue.grid.size[1])
    {
    }

    /// The new values of a slice's row, as runs of single voxels.
    void smoothRow(int j, int k, std::vector<std::uint8_t>& row) const
    {
        const std::uint8_t* at = &tissue_.voxels[tissue_.grid.offset({0, j, k})];
        std::copy_n(at, row_, row.begin());
        for (std::ptrdiff_t i = 1; i + 1 < row_; ++i)
            if (at[i] >= kFrom * kWhole && at[i] <= kTo * kWhole)
                row[std::size_t(i)] = mean(at + i);
    }

private:
    std::uint8_t mean(const std::uint8_t* at) const
    {
        float sum = 0, weights = 0;
        for (std::ptrdiff_t k = -1; k <= 1; ++k)
            for (std::ptrdiff_t j = -1; j <= 1; ++j)
                for (std::ptrdiff_t i = -1; i <= 1; ++i) {
                    const std::uint8_t value = at[i + j * row_ + k * slice_];
                    const float weight =
                        float((2 - i * i) * (2 - j * j) * (2 - k * k)) * weights_[std::size_t(std::abs(value - *at))];
                    sum += weight * float(value);
                    weights += weight;
                }
        return std::uint8_t(std::lround(sum / weights));
    }

    const TissueVolume& tissue_;
    std::array<float, 256> weights_;
    std::ptrdiff_t row_, slice_;
};

}  // namespace

void smoothAlongWall(double noise, TissueVolume& tissue)
{
    const int nx = tissue.grid.size[0], ny = tissue.grid.size[1], nz = tissue.grid.size[2];
    // Slabs of slices, so that a pass needs little memory beside the volume itself.
    constexpr int kSlab = 32;
    const Smoothing smoothing(noise, tissue);
    const auto slice = std::size_t(nx) * std::size_t(ny);
    for (int pass = 0; pass < kPasses; ++pass) {
        std::vector<std::uint8_t> last, slab(slice * kSlab);
        for (int first = 1; first < nz - 1; first += kSlab) {
            const int count = std::min(kSlab, nz - 1 - first);
            tbb::parallel_for(0, count, [&](int n) {
                std::vector<std::uint8_t> values(static_cast<std::size_t>(nx));
                for (int j = 1; j < ny - 1; ++j) {
                    smoothing.smoothRow(j, first + n, values);
                    std::copy(values.begin(), values.end(),
                              &slab[std::size_t(n) * slice + std::size_t(j) * std::size_t(nx)]);
                }
            });
            // The slab before is put back when this one has been made of it.
            const auto put = [&](const std::vector<std::uint8_t>& values, int at, int slices) {
                for (int k = 0; k < slices; ++k)
                    for (int j = 1; j < ny - 1; ++j)
                        std::copy_n(&values[std::size_t(k) * slice + std::size_t(j) * std::size_t(nx)], nx,
                                    &tissue.voxels[tissue.grid.offset({0, j, at + k})]);
            };
            if (!last.empty())
                put(last, first - kSlab, kSlab);
            last.swap(slab);
            slab.resize(slice * kSlab);
            if (first + count >= nz - 1)
                put(last, first, count);
        }
    }
}

}  // namespace vicon::steps

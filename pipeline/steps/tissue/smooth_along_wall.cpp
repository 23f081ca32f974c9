#include "tissue/smooth_along_wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

/// The wall's blurred edge, of kWhole: 0.08 to 0.92.
constexpr std::uint8_t kFrom = 20, kTo = 235;
/// What each pass takes of the mean over 3 x 3 x 3 voxels: of a ripple of four voxels, 2.7 mm, two take off three
/// quarters. The last gives back what they took from wide bends: a polyp of 5 mm keeps its size.
constexpr std::array kPasses{1.0F, 1.0F, -0.7F};
/// Across the wall a voxel so far away counts for a quarter.
constexpr float kAcross_voxels = 0.5F;
/// The fraction's rise over a voxel that tells which way the wall lies. In noise of 80 HU a mean slope is half of it.
constexpr float kLeastSlope = 0.05F;

/// The 3 x 3 x 3 voxels around one, with the weights of a binomial mean.
struct Around {
    explicit Around(const Grid& grid)
    {
        const std::ptrdiff_t row = grid.size[0], slice = row * grid.size[1];
        std::size_t n = 0;
        for (int dk = -1; dk <= 1; ++dk)
            for (int dj = -1; dj <= 1; ++dj)
                for (int di = -1; di <= 1; ++di, ++n) {
                    i[n] = float(di);
                    j[n] = float(dj);
                    k[n] = float(dk);
                    weight[n] = float((2 - di * di) * (2 - dj * dj) * (2 - dk * dk)) / 64;
                    stride[n] = di + dj * row + dk * slice;
                }
    }

    static constexpr std::size_t kCount = 28;  // one without weight: four at a time
    std::array<float, kCount> i{}, j{}, k{}, weight{};
    std::array<std::ptrdiff_t, kCount> stride{};
};

class Smoothing {
public:
    Smoothing(const std::vector<std::uint8_t>& of_three, const TissueVolume& tissue)
        : tissue_(tissue), of_three_(of_three), around_(tissue.grid)
    {
    }

    /// The new values of a row.
    void smoothRow(int j, int k, float share, std::vector<std::uint8_t>& row) const
    {
        const std::size_t begin = tissue_.grid.offset({0, j, k}), last = row.size() - 1;
        const std::uint8_t* at = &tissue_.voxels[begin];
        const std::uint8_t* of_three = of_three_.empty() ? nullptr : &of_three_[begin];
        std::copy_n(at, row.size(), row.begin());
        for (std::size_t i = 1; i < last; ++i) {
            if (i + sizeof(std::uint64_t) <= last && isPure(at + i) && (!of_three || eightOf(of_three + i) == 0)) {
                i += sizeof(std::uint64_t) - 1;
                continue;
            }
            if ((at[i] >= kFrom && at[i] <= kTo) || (of_three && of_three[i]))
                row[i] = stored((at[i] + share * (meanAlongWall(at + i) - at[i])) / kWhole);
        }
    }

private:
    static std::uint64_t eightOf(const std::uint8_t* at)
    {
        std::uint64_t eight;
        std::memcpy(&eight, at, sizeof eight);
        return eight;
    }
    /// Whether eight voxels of a row are all lumen or all tissue.
    static bool isPure(const std::uint8_t* at)
    {
        const std::uint64_t eight = eightOf(at);
        return eight == 0 || eight == ~std::uint64_t(0);
    }

    /// Of a voxel and those beside it in the plane across the slope; of all where there is none.
    float meanAlongWall(const std::uint8_t* at) const
    {
        std::array<float, Around::kCount> values;
        float x = 0, y = 0, z = 0;
        for (std::size_t n = 0; n < values.size(); ++n) {
            values[n] = float(at[around_.stride[n]]);
            const float weighted = around_.weight[n] * values[n];
            x += around_.i[n] * weighted;
            y += around_.j[n] * weighted;
            z += around_.k[n] * weighted;
        }
        const float slope = std::sqrt(x * x + y * y + z * z);
        const float unit = slope > kLeastSlope / 2 * kWhole ? 1 / (slope * kAcross_voxels) : 0;
        float sum = 0, weights = 0;
        for (std::size_t n = 0; n < values.size(); ++n) {
            const float depth = (around_.i[n] * x + around_.j[n] * y + around_.k[n] * z) * unit;
            const float off = 1 + depth * depth, weight = around_.weight[n] / (off * off);
            sum += weight * values[n];
            weights += weight;
        }
        return sum / weights;
    }

    const TissueVolume& tissue_;
    const std::vector<std::uint8_t>& of_three_;
    Around around_;
};

}  // namespace

void smoothAlongWall(const std::vector<std::uint8_t>& of_three, TissueVolume& tissue)
{
    const int nx = tissue.grid.size[0], ny = tissue.grid.size[1], nz = tissue.grid.size[2];
    // Slabs of slices, so that a pass needs little memory beside the volume itself.
    constexpr int kSlab = 32;
    const Smoothing smoothing(of_three, tissue);
    const auto slice = std::size_t(nx) * std::size_t(ny);
    for (const float share : kPasses) {
        std::vector<std::uint8_t> last, slab(slice * kSlab);
        for (int first = 1; first < nz - 1; first += kSlab) {
            const int count = std::min(kSlab, nz - 1 - first);
            tbb::parallel_for(0, count, [&](int n) {
                std::vector<std::uint8_t> values(static_cast<std::size_t>(nx));
                for (int j = 1; j < ny - 1; ++j) {
                    smoothing.smoothRow(j, first + n, share, values);
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

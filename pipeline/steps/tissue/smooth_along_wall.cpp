#include "tissue/smooth_along_wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "grid/byte_rows.h"
#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

// Held by tissue_test: polyps of 5 to 10 mm keep their width and height at a noise of 10 to 80 HU. Half and
// double of kTo move the wall of ctc-prone by 0.03 mm in the mean, of kAcrossWall_voxels by 0.013 mm, of the others by
// less than 0.004 mm.

/// The wall's blurred edge, of kWhole: 0.08 to 0.92.
constexpr std::uint8_t kFrom = 20, kTo = 235;
/// What each pass takes of the mean over 3 x 3 x 3 voxels. Of a bend of which one pass takes the part k, together they
/// leave (1 - k)^3 (1 + 3 k): of wide ones, as of polyps, nearly all, of a ripple of four voxels, 2.7 mm, less than a
/// third.
constexpr std::array kPasses{1.0F, 1.0F, 1.0F, -3.0F};
/// Across the wall a voxel so far away counts for a quarter.
constexpr float kAcrossWall_voxels = 0.5F;
/// The fraction's rise over a voxel that tells which way the wall lies. In noise of 80 HU a mean slope is half of it.
constexpr float kLeastWallSlope = 0.05F;

/// Four numbers that the compiler keeps in one register.
using Lanes = float __attribute__((vector_size(16)));
using Bytes = std::uint8_t __attribute__((vector_size(4)));

inline float sumOf(const Lanes& lanes)
{
    return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// The nine rows of 3 x 3 x 3 voxels around one, j before k, each with the voxel behind it, which weighs nothing: four
/// at a time. Row 8 - n is row n seen from the other side.
using NineRows = std::array<Lanes, 9>;

/// A row's weights in a binomial mean.
constexpr Lanes binomial(int row)
{
    const int dj = row % 3 - 1, dk = row / 3 - 1, share = (2 - dj * dj) * (2 - dk * dk);
    return Lanes{1, 2, 1, 0} * (float(share) / 64);
}
/// Of all nine.
constexpr NineRows kBinomial = {binomial(0), binomial(1), binomial(2), binomial(3), binomial(4),
                                binomial(5), binomial(6), binomial(7), binomial(8)};

/// The slope of the fraction.
struct Slope {
    float x = 0, y = 0, z = 0;
};

/// Where rows begin, from the voxel in the middle.
std::array<std::ptrdiff_t, 9> rowsAround(const Grid& grid)
{
    const std::ptrdiff_t row = grid.size[0], slice = row * grid.size[1];
    std::array<std::ptrdiff_t, 9> rows{};
    for (std::size_t n = 0; n < rows.size(); ++n)
        rows[n] = (std::ptrdiff_t(n) % 3 - 1) * row + (std::ptrdiff_t(n) / 3 - 1) * slice - 1;
    return rows;
}

Slope slopeOf(const NineRows& values)
{
    NineRows part;
    Lanes x{};
    for (std::size_t n = 0; n < part.size(); ++n) {
        part[n] = kBinomial[n] * values[n];
        x += part[n];
    }
    return {x[2] - x[0], sumOf(part[2] - part[0] - part[3] + part[5] - part[6] + part[8]),
            sumOf(part[6] - (part[0] + part[1] + part[2]) + part[7] + part[8])};
}

/// Of a voxel and those beside it in the plane across `unit`, which is as long as one over the depth that counts for a
/// quarter; of all where it is 0.
float meanAcross(const Slope& unit, const NineRows& values)
{
    const Lanes along = Lanes{-1, 0, 1, 0} * unit.x;
    const float y = unit.y, z = unit.z;
    const std::array<float, 5> depths = {-y - z, -z, y - z, -y, 0};
    NineRows weights;
    for (std::size_t n = 0; n < depths.size(); ++n) {
        const Lanes depth = along + depths[n], off = 1 + depth * depth;
        weights[n] = kBinomial[n] / (off * off);
        weights[8 - n] = __builtin_shufflevector(weights[n], weights[n], 2, 1, 0, 3);
    }
    Lanes sum{}, all{};
    for (std::size_t n = 0; n < values.size(); ++n) {
        sum += weights[n] * values[n];
        all += weights[n];
    }
    return sumOf(sum) / sumOf(all);
}

/// A voxel's new value.
struct Changed {
    std::size_t voxel;
    std::uint8_t value;
};

class Smoothing {
public:
    Smoothing(const std::vector<std::uint8_t>& of_three, const TissueVolume& tissue)
        : tissue_(tissue), of_three_(of_three), rows_(rowsAround(tissue.grid))
    {
    }

    /// Adds the new values of a row.
    void smoothRow(int j, int k, float share, std::vector<Changed>& changed) const
    {
        const std::array<int, 3>& size = tissue_.grid.size;
        // With each three of a row that behind them is read; behind the grid's last voxel there is none.
        const bool at_end = j == size[1] - 2 && k == size[2] - 2;
        const std::size_t begin = tissue_.grid.offset({0, j, k}), last = std::size_t(size[0] - (at_end ? 2 : 1));
        const std::uint8_t* at = &tissue_.voxels[begin];
        const std::uint8_t* of_three = of_three_.empty() ? nullptr : &of_three_[begin];
        for (std::size_t i = 1; i < last; ++i) {
            if (i + sizeof(std::uint64_t) <= last && isPure(at + i) && (!of_three || eightOf(of_three + i) == 0)) {
                i += sizeof(std::uint64_t) - 1;
                continue;
            }
            if ((at[i] >= kFrom && at[i] <= kTo) || (of_three && of_three[i]))
                changed.push_back({begin + i, stored((at[i] + share * (meanAlongWall(at + i) - at[i])) / kWhole)});
        }
    }

private:
    /// Whether eight voxels of a row are all lumen or all tissue.
    static bool isPure(const std::uint8_t* at)
    {
        const std::uint64_t eight = eightOf(at);
        return eight == 0 || eight == ~std::uint64_t(0);
    }

    float meanAlongWall(const std::uint8_t* at) const
    {
        NineRows values;
        for (std::size_t n = 0; n < values.size(); ++n) {
            Bytes four;
            std::memcpy(&four, at + rows_[n], sizeof four);
            values[n] = __builtin_convertvector(four, Lanes);
        }
        const auto [x, y, z] = slopeOf(values);
        const float slope = std::sqrt(x * x + y * y + z * z);
        const float unit = slope > kLeastWallSlope / 2 * kWhole ? 1 / (slope * kAcrossWall_voxels) : 0;
        return meanAcross({x * unit, y * unit, z * unit}, values);
    }

    const TissueVolume& tissue_;
    const std::vector<std::uint8_t>& of_three_;
    std::array<std::ptrdiff_t, 9> rows_;
};

}  // namespace

void smoothAlongWall(const std::vector<std::uint8_t>& of_three, TissueVolume& tissue)
{
    const int ny = tissue.grid.size[1], nz = tissue.grid.size[2];
    const Smoothing smoothing(of_three, tissue);
    std::vector<std::vector<Changed>> changed(static_cast<std::size_t>(nz));  // by slices
    for (const float share : kPasses) {
        tbb::parallel_for(1, std::max(1, nz - 1), [&](int k) {
            auto& here = changed[std::size_t(k)];
            here.clear();
            for (int j = 1; j < ny - 1; ++j)
                smoothing.smoothRow(j, k, share, here);
        });
        tbb::parallel_for(std::size_t(0), changed.size(), [&](std::size_t k) {
            for (const Changed& one : changed[k])
                tissue.voxels[one.voxel] = one.value;
        });
    }
}

}  // namespace vicon::steps

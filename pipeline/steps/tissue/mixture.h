#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/lattice.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// All of a voxel is tissue.
inline constexpr float kWhole = 255;

/// The first stored value of more than half.
inline constexpr std::uint8_t kHalfTissue = 128;

inline std::uint8_t stored(double fraction)
{
    return std::uint8_t(std::clamp(fraction, 0.0, 1.0) * kWhole + 0.5);
}

/// The densities on the grid of the labels, and those of the pure contents.
class Mixture {
public:
    /// References must outlive it. Throws Error{bad_input} when the grids are not on one lattice.
    Mixture(const HuVolume& hu, const InsideVolume& inside, const WallDensities& densities)
        : inside(inside),
          tissue_hu(densities.tissue_hu),
          gas_hu(2 * densities.wall_hu - densities.tissue_hu),
          hu_(hu),
          offset_(latticeOffset(inside.grid, hu.grid))
    {
    }

    /// The same densities under other labels, on the same grid.
    Mixture with(const InsideVolume& labels) const { return {*this, labels}; }

    /// The density of a voxel of the labels' grid, or kPaddingHu.
    std::int16_t acquired(Index3 v) const
    {
        return hu_.valueOr({v.i + offset_.i, v.j + offset_.j, v.k + offset_.k}, kPaddingHu);
    }
    /// The same; where none was measured that of what its label says.
    std::int16_t hu(Index3 v) const
    {
        const std::int16_t value = acquired(v);
        if (value != kPaddingHu)
            return value;
        return std::int16_t(inside.valueOr(v, kOutside) == kGas ? gas_hu : tissue_hu);
    }
    /// The densities of a row of the labels' grid, or null where they do not reach so far.
    const std::int16_t* row(int j, int k) const
    {
        const Index3 first{offset_.i, j + offset_.j, k + offset_.k};
        const Index3 last{offset_.i + inside.grid.size[0] - 1, first.j, first.k};
        return hu_.grid.contains(first) && hu_.grid.contains(last) ? &hu_.at(first) : nullptr;
    }
    /// The fraction of tissue in a mixture with something of another density.
    double fraction(double hu, double other_hu) const { return (hu - other_hu) / (tissue_hu - other_hu); }

    const InsideVolume& inside;
    const double tissue_hu;
    const double gas_hu;

private:
    Mixture(const Mixture& other, const InsideVolume& labels)
        : inside(labels), tissue_hu(other.tissue_hu), gas_hu(other.gas_hu), hu_(other.hu_), offset_(other.offset_)
    {
    }

    const HuVolume& hu_;
    Index3 offset_;
};

}  // namespace vicon::steps

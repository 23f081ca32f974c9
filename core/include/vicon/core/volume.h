#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// A scalar image in patient coordinates: `voxels[grid.offset({i,j,k})]`, i fastest.
template <class T>
struct Volume {
    Grid grid;
    std::vector<T> voxels;

    Volume() = default;
    explicit Volume(const Grid& g, T fill = T{}) : grid(g), voxels(g.voxelCount(), fill) {}

    T& at(Index3 v) { return voxels[grid.offset(v)]; }
    const T& at(Index3 v) const { return voxels[grid.offset(v)]; }
    /// The voxel's value, or `outside` where `v` is not in the grid.
    T valueOr(Index3 v, T outside) const { return grid.contains(v) ? at(v) : outside; }
};

using HuVolume = Volume<std::int16_t>;        ///< densities in HU
using InsideVolume = Volume<std::uint8_t>;    ///< InsideLabel values
using SegmentVolume = Volume<std::uint16_t>;  ///< 0 outside, 1..N from the rectum
using FieldVolume = Volume<float>;            ///< potential fields, mm

/// What a voxel of `inside.mha` holds.
enum InsideLabel : std::uint8_t { kOutside = 0, kGas = 1, kFluid = 2 };

/// The density that stands for "nothing was measured here" (DICOM's padding) in a HuVolume. One below -1024, which is a
/// measured density: most scanners clip gas and air there (a stored 0 with the usual intercept).
inline constexpr std::int16_t kPaddingHu = -1025;

}  // namespace vicon

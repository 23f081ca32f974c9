#pragma once

#include <span>

#include "vicon/core/volume.h"

namespace vicon {

/// A volume to look at: the voxels belong to somebody else (a Volume, a mapped file), who must outlive it. Cheap to
/// copy.
template <class T>
struct VolumeView {
    Grid grid;
    std::span<const T> voxels;

    VolumeView() = default;
    VolumeView(const Grid& g, std::span<const T> v) : grid(g), voxels(v) {}
    /// Implicit: a volume is passed as it is where one is only looked at.
    VolumeView(const Volume<T>& volume) : grid(volume.grid), voxels(volume.voxels) {}

    const T& at(Index3 v) const { return voxels[grid.offset(v)]; }
    /// The voxel's value, or `outside` where `v` is not in the grid.
    T valueOr(Index3 v, T outside) const { return grid.contains(v) ? at(v) : outside; }
};

using HuView = VolumeView<std::int16_t>;
using InsideView = VolumeView<std::uint8_t>;
using SegmentView = VolumeView<std::uint16_t>;
using FieldView = VolumeView<float>;

}  // namespace vicon

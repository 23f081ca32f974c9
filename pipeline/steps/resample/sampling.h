#pragma once

#include <array>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::steps {

/// Between which two acquired voxels a new one lies along one axis; high == low where it lies on one.
struct Tap {
    int low = 0, high = 0;
    float weight = 0;  ///< of `high`
    int nearest() const { return weight >= 0.5F ? high : low; }
};

/// Slices from `begin` to before `end`.
struct SliceRange {
    int begin = 0, end = 0;
    int count() const { return end - begin; }
};

/// Where the new voxels lie among those acquired. Both grids begin at the same voxel and have the same axes.
struct Sampling {
    Grid grid;  ///< of the new voxels
    std::array<int, 3> acquired_size{};
    std::array<double, 3> acquired_in_new_voxels{};  ///< spacing of the acquired voxels; exactly 1 where it stays
    std::array<std::vector<Tap>, 3> taps;

    bool moves(std::size_t axis) const { return acquired_in_new_voxels[axis] != 1; }
    bool movesAny() const { return moves(0) || moves(1) || moves(2); }
    /// The acquired slices that some new slices lie between, and `margin` more on each side.
    SliceRange acquiredAround(SliceRange of_new, int margin = 0) const;
};

/// Isotropic voxels over an acquired grid; none lies beyond the last acquired voxel.
/// Throws Error{no_memory} for more than a million voxels along an axis.
Sampling sampleIsotropically(const Grid& acquired, double spacing_mm);

}  // namespace vicon::steps

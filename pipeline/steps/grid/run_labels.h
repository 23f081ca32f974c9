#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// Neighbouring voxels of one row of a volume: i in [begin, end).
struct VoxelRun {
    int begin = 0;
    int end = 0;
    float sum = 0;            ///< of what the scanner adds up, such as densities
    std::uint32_t label = 0;  ///< number of the component, from 0 in order of its first voxel
};

/// One connected set of voxels.
struct RunComponent {
    std::size_t voxels = 0;
    double sum = 0;
    Index3 lower{1 << 30, 1 << 30, 1 << 30};  ///< bounding box, both ends included
    Index3 upper{-1, -1, -1};
    ContinuousIndex3 centre;
    double mean() const { return voxels ? sum / double(voxels) : 0; }
};

/// Connected components of a set of voxels as runs: fast where the set is sparse, and no second volume is needed.
struct RunLabels {
    std::array<int, 3> size{0, 0, 0};
    std::vector<std::size_t> row_begin;  ///< first run of row j + size[1] * k; one more entry than rows
    std::vector<VoxelRun> runs;
    std::vector<RunComponent> components;

    std::size_t row(int j, int k) const { return std::size_t(j) + std::size_t(size[1]) * std::size_t(k); }
    /// Number of the component that holds the voxel, or -1.
    int labelAt(Index3 v) const;
    /// Calls `use(run, j, k)` for every run, slices in parallel; `use` must only touch its own row or slice.
    void forEachRun(const std::function<void(const VoxelRun&, int j, int k)>& use) const;
};

/// Appends the runs of a row, in order, not touching one another.
using RowScanner = std::function<void(int j, int k, std::vector<VoxelRun>& runs)>;

enum class Neighbours { faces, all };

/// Labels a set of voxels that `scan` gives row by row (called from several threads).
RunLabels labelRuns(const std::array<int, 3>& size, const RowScanner& scan, Neighbours neighbours);

/// Components of gas and fluid; a run's sum is the number of its voxels of fluid.
RunLabels labelLumen(const InsideVolume& labels, Neighbours neighbours);

/// The voxels of a component, in order.
std::vector<std::size_t> voxelsOf(const RunLabels& labels, std::uint32_t component, const Grid& grid);

}  // namespace vicon::steps

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::ingest {

/// Labels on a lattice, as they come. Memory is taken for slices that hold any.
class LabelledSlices {
public:
    explicit LabelledSlices(const Grid& grid) : grid_(grid), slices_(std::size_t(grid.size[2])) {}

    /// 0 is no label. Returns false when there are more labels than any mask has: it is an image.
    bool set(Index3 voxel, std::int64_t label);
    /// How many voxels each label has.
    const std::map<std::int64_t, std::uint64_t>& counts() const { return counts_; }
    /// 1 where that label is; cropped to it, with a voxel around as far as the lattice goes. It has voxels.
    InsideVolume only(std::int64_t label) const;
    /// Of the lattice.
    Point3 middle_mm() const;

private:
    using Code = std::uint8_t;
    Code codeOf(std::int64_t label);

    Grid grid_;
    std::vector<std::vector<Code>> slices_;
    std::map<std::int64_t, Code> codes_;
    std::map<std::int64_t, std::uint64_t> counts_;
    std::int64_t last_label_ = 0;
    Code last_code_ = 0;
    std::uint64_t* last_count_ = nullptr;
};

}  // namespace vicon::ingest

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "source_images.h"
#include "vicon/core/volume_view.h"

namespace vicon::report {

/// Which pixels of an image lie in the lumen: one byte a pixel, 0 or 1, by row; empty where none does. Between voxels
/// the labels are interpolated, and half of them is the border.
class LumenOnPlanes {
public:
    explicit LumenOnPlanes(const InsideView& inside);
    std::vector<std::uint8_t> on(const ImagePlane& plane) const;

private:
    /// What a cube of voxels holds, its neighbours above included.
    enum class Block : std::uint8_t { outside, inside, border };

    void findExtent();
    void sortBlocks();
    Block blockAt(Index3 first) const;
    /// In what kind of block a place lies, and for how many columns from it.
    struct Run {
        Block block;
        int columns;
    };
    Run runAt(const std::array<double, 3>& at, const std::array<double, 3>& step) const;
    bool holds(const std::array<double, 3>& at) const;

    InsideView inside_;
    std::array<double, 3> least_{}, most_{};  ///< voxels around the lumen
    std::array<int, 3> block_count_{};
    std::vector<Block> blocks_;
};

}  // namespace vicon::report

#pragma once

#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// Where tagging is mottled as stool and sediment are, so that wall cannot be told from what lies on it: blocks of the
/// lumen.
struct MottledTagging {
    double block_mm = 0;            ///< side of a block
    std::vector<Point3> blocks_mm;  ///< their middles

    double blockVolume_ml() const { return block_mm * block_mm * block_mm / 1000; }
    double volume_ml() const { return double(blocks_mm.size()) * blockVolume_ml(); }
};

}  // namespace vicon

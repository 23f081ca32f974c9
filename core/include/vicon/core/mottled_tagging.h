#pragma once

#include <cstddef>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// Where tagging is stool or mottled as sediment is, so that what lies on the wall may not be told from it: blocks of
/// the lumen.
struct MottledTagging {
    double block_mm = 0;            ///< side of a block
    std::vector<Point3> blocks_mm;  ///< their middles
    std::vector<double> shares;     ///< of each block that is such tagging, as many as blocks

    void add(Point3 block, double share)
    {
        blocks_mm.push_back(block);
        shares.push_back(share);
    }
    double volume_ml(std::size_t block) const { return shares[block] * block_mm * block_mm * block_mm / 1000; }
    double volume_ml() const
    {
        double sum_ml = 0;
        for (std::size_t n = 0; n < shares.size(); ++n)
            sum_ml += volume_ml(n);
        return sum_ml;
    }
};

}  // namespace vicon

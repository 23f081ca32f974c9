#pragma once

#include "vicon/phantom/phantom.h"

namespace vicon::phantom {

/// Options of a phantom small enough for a test: the whole patient in voxels of about 3 mm.
inline PhantomOptions smallOptions(std::uint64_t seed = 1)
{
    PhantomOptions options;
    options.seed = seed;
    options.size = {128, 128, 108};
    return options;
}

inline PhantomScan scanOf(const PhantomOptions& options, const std::string& position = "HFS")
{
    NoProgress progress;
    return makeScan(options, position, progress);
}

/// The small phantom of seed 1 without noise; made once.
inline const PhantomScan& cleanScan()
{
    static const PhantomScan scan = [] {
        PhantomOptions options = smallOptions();
        options.noise_hu = 0;
        return scanOf(options);
    }();
    return scan;
}

}  // namespace vicon::phantom

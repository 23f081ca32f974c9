#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace vicon::steps {

/// Offsets of voxels, ascending, each once.
inline std::vector<std::size_t> sortedOnce(std::vector<std::size_t> voxels)
{
    std::sort(voxels.begin(), voxels.end());
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
    return voxels;
}

/// What is in the first list of voxels and not in the second, both ascending.
inline std::vector<std::size_t> without(const std::vector<std::size_t>& voxels, const std::vector<std::size_t>& others)
{
    std::vector<std::size_t> rest;
    std::set_difference(voxels.begin(), voxels.end(), others.begin(), others.end(), std::back_inserter(rest));
    return rest;
}

}  // namespace vicon::steps

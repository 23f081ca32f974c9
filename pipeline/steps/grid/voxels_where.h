#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/byte_rows.h"
#include "vicon/core/geometry.h"

namespace vicon::steps {

/// The voxels that are wanted, in order. None is where `bytes` has `never`.
template <class Wanted>
std::vector<std::size_t> voxelsWhere(const Grid& grid, const std::vector<std::uint8_t>& bytes, std::uint8_t never,
                                     Wanted wanted)
{
    const auto slice = std::size_t(grid.size[0]) * std::size_t(grid.size[1]);
    std::vector<std::vector<std::size_t>> slices(std::size_t(grid.size[2]), std::vector<std::size_t>{});
    tbb::parallel_for(std::size_t(0), slices.size(), [&](std::size_t k) {
        const std::size_t end = (k + 1) * slice;
        const auto next = [&](std::size_t n) { return firstOther(bytes.data(), n, end, never); };
        for (std::size_t n = next(k * slice); n < end; n = next(n + 1))
            if (wanted(n))
                slices[k].push_back(n);
    });
    std::vector<std::size_t> all;
    for (const auto& s : slices)
        all.insert(all.end(), s.begin(), s.end());
    return all;
}

}  // namespace vicon::steps

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vicon::viewer {

/// A run of triangles of one cell that is drawn or left out as a whole. The pipeline orders a cell's triangles so that
/// any run of them is compact.
struct Patch {
    std::uint32_t first_triangle = 0;
    std::uint32_t triangles = 0;
    std::uint16_t cell = 0;
};

/// Triangles of a patch: small enough that little of a patch in sight is out of sight, large enough that few patches
/// are asked. Chosen among 6, 12, 24, 50, 100 and more on ctc-prone and the default phantom.
constexpr std::uint32_t kPatchTriangles = 12;

/// Cuts the triangles of each cell into patches as equal as may be.
/// @param cell of each triangle, never decreasing
inline std::vector<Patch> patchesOf(const std::vector<std::uint16_t>& cell, std::uint32_t most = kPatchTriangles)
{
    std::vector<Patch> patches;
    for (std::size_t first = 0; first < cell.size();) {
        const auto end =
            std::size_t(std::upper_bound(cell.begin() + std::ptrdiff_t(first), cell.end(), cell[first]) - cell.begin());
        const std::size_t count = end - first, parts = (count + most - 1) / most;
        for (std::size_t n = 0; n < parts; ++n) {
            const std::size_t from = first + count * n / parts, to = first + count * (n + 1) / parts;
            patches.push_back({std::uint32_t(from), std::uint32_t(to - from), cell[first]});
        }
        first = end;
    }
    return patches;
}

}  // namespace vicon::viewer

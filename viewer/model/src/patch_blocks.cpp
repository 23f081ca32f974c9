#include "patch_blocks.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace vicon::viewer {
namespace {

/// A triangle's place: its block and patch, and the bit of its cube.
struct Found {
    std::uint64_t block_and_patch;
    std::uint64_t cube;
};

}  // namespace

PatchBlocks::PatchBlocks(const Grid& grid, const DrawnSurface& surface)
{
    std::size_t blocks = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        size_[d] = (grid.size[d] >> 2) + 1;
        blocks *= std::size_t(size_[d]);
    }
    // The contour puts each triangle into one cube; its middle tells which.
    const auto foundAt = [&](std::size_t t, std::size_t patch) {
        Vector3 sum;
        for (std::size_t n = 0; n < 3; ++n) {
            const float* p = &surface.points_mm[3 * std::size_t(surface.triangles[3 * t + n])];
            sum += Vector3{p[0], p[1], p[2]};
        }
        const ContinuousIndex3 c = grid.continuousIndexAt(Point3{} + sum / 3);
        const std::array<double, 3> at{c.i, c.j, c.k};
        std::array<int, 3> cube{};
        for (std::size_t d = 0; d < 3; ++d)
            cube[d] = std::clamp(int(std::floor(at[d])) + 1, 0, 4 * size_[d] - 1);
        const int bit = (cube[0] & 3) + 4 * (cube[1] & 3) + 16 * (cube[2] & 3);
        return Found{std::uint64_t(offset({cube[0] >> 2, cube[1] >> 2, cube[2] >> 2})) << 32 | patch, std::uint64_t(1)
                                                                                                          << bit};
    };
    std::vector<std::vector<Found>> of_patch(surface.patches.size());
    tbb::parallel_for(std::size_t(0), surface.patches.size(), [&](std::size_t p) {
        std::vector<Found>& found = of_patch[p];
        const Patch& patch = surface.patches[p];
        for (std::size_t t = patch.first_triangle; t < patch.first_triangle + patch.triangles; ++t)
            found.push_back(foundAt(t, p));
        std::sort(found.begin(), found.end(),
                  [](const Found& a, const Found& b) { return a.block_and_patch < b.block_and_patch; });
        std::vector<Found> merged;
        for (const Found& f : found)
            if (!merged.empty() && merged.back().block_and_patch == f.block_and_patch)
                merged.back().cube |= f.cube;
            else
                merged.push_back(f);
        found = std::move(merged);
    });
    first_.assign(blocks + 1, 0);
    for (const auto& found : of_patch)
        for (const Found& f : found)
            ++first_[(f.block_and_patch >> 32) + 1];
    for (std::size_t n = 0; n < blocks; ++n)
        first_[n + 1] += first_[n];
    entries_.resize(first_[blocks]);
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const auto& found : of_patch)
        for (const Found& f : found)
            entries_[next[f.block_and_patch >> 32]++] = {f.cube, std::uint32_t(f.block_and_patch & 0xFFFFFFFF)};
}

}  // namespace vicon::viewer

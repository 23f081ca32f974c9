#include "patch_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vicon::viewer {
namespace {

/// Where a patch has triangles: a block and the bits of its cubes.
struct Found {
    std::size_t block;
    std::uint64_t cubes;
};

// The contour puts each triangle into one cube; its middle tells which.
std::array<int, 3> cubeOf(const Grid& grid, const DrawnSurface& surface, std::size_t triangle)
{
    Vector3 sum;
    for (std::size_t n = 0; n < 3; ++n) {
        const float* p = &surface.points_mm[3 * std::size_t(surface.triangles[3 * triangle + n])];
        sum += Vector3{p[0], p[1], p[2]};
    }
    const ContinuousIndex3 c = grid.continuousIndexAt(Point3{} + sum / 3);
    const std::array<double, 3> at{c.i, c.j, c.k};
    std::array<int, 3> cube{};
    for (std::size_t d = 0; d < 3; ++d)
        cube[d] = std::clamp(int(std::floor(at[d])) + 1, 0, grid.size[d]);
    return cube;
}

// Each block once.
std::vector<Found> foundOf(const Patch& patch, const Grid& grid, const BlockGrid& blocks, const DrawnSurface& surface)
{
    std::vector<Found> found;
    for (std::size_t t = patch.first_triangle; t < patch.first_triangle + patch.triangles; ++t) {
        const std::array<int, 3> cube = cubeOf(grid, surface, t);
        found.push_back({blocks.blockOf(cube), std::uint64_t(1) << BlockGrid::placeOf(cube)});
    }
    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.block < b.block; });
    std::vector<Found> merged;
    for (const Found& f : found)
        if (!merged.empty() && merged.back().block == f.block)
            merged.back().cubes |= f.cubes;
        else
            merged.push_back(f);
    return merged;
}

}  // namespace

PatchBlocks::PatchBlocks(const Grid& grid, const DrawnSurface& surface)
    : blocks_({grid.size[0] + 1, grid.size[1] + 1, grid.size[2] + 1}), patches_(surface.patches.size())
{
    std::vector<std::vector<Found>> of_patch(patches_);
    tbb::parallel_for(std::size_t(0), patches_,
                      [&](std::size_t p) { of_patch[p] = foundOf(surface.patches[p], grid, blocks_, surface); });
    std::vector<std::uint32_t> entries(blocks_.count(), 0);
    for (const auto& found : of_patch)
        for (const Found& f : found)
            ++entries[f.block];
    number_.assign(blocks_.count(), kEmpty);
    first_.assign(1, 0);
    for (std::size_t block = 0; block < entries.size(); ++block)
        if (entries[block] > 0) {
            number_[block] = std::uint32_t(first_.size() - 1);
            first_.push_back(first_.back() + entries[block]);
        }
    entries_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t p = 0; p < patches_; ++p)
        for (const Found& f : of_patch[p])
            entries_[next[number_[f.block]]++] = {f.cubes, std::uint32_t(p)};
}

std::vector<std::uint8_t> PatchBlocks::patchesIn(const Cubes& cubes) const
{
    std::vector<std::uint8_t> in(patches_, 0);
    for (std::size_t block = 0; block < cubes.size(); ++block)
        if (cubes[block])
            for (std::uint32_t n = first_[block]; n < first_[block + 1]; ++n)
                if (entries_[n].cubes & cubes[block])
                    in[entries_[n].patch] = 1;
    return in;
}

}  // namespace vicon::viewer

#include "sight_field.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace vicon::viewer {
namespace {

/// Distances are counted up to here, which is more than half of any lumen.
constexpr std::uint8_t kMost = 100;

using Row = std::uint8_t*;

// One row of the two sweeps that give the chessboard distance: the least of the three nearest values of four rows that
// are done already, and of the neighbour in the row itself, plus one.
void sweepRow(Row row, const std::array<const std::uint8_t*, 4>& done, int width, bool forward,
              std::vector<std::uint8_t>& least)
{
    least.assign(std::size_t(width) + 2, kMost);
    for (const std::uint8_t* other : done)
        if (other)
            for (int i = 0; i < width; ++i)
                least[std::size_t(i) + 1] = std::min(least[std::size_t(i) + 1], other[i]);
    for (int i = 0; i < width; ++i) {
        const auto near = std::min({least[std::size_t(i)], least[std::size_t(i) + 1], least[std::size_t(i) + 2]});
        row[i] = std::min(row[i], std::uint8_t(near + 1));
    }
    if (forward)
        for (int i = 1; i < width; ++i)
            row[i] = std::min(row[i], std::uint8_t(row[i - 1] + 1));
    else
        for (int i = width - 2; i >= 0; --i)
            row[i] = std::min(row[i], std::uint8_t(row[i + 1] + 1));
}

void sweep(std::vector<std::uint8_t>& steps, const std::array<int, 3>& size, bool forward, const Progress* wanted)
{
    const auto rowAt = [&](int j, int k) -> Row {
        if (j < 0 || j >= size[1] || k < 0 || k >= size[2])
            return nullptr;
        return steps.data() + std::size_t(size[0]) * (std::size_t(j) + std::size_t(size[1]) * std::size_t(k));
    };
    const int back = forward ? -1 : 1;
    std::vector<std::uint8_t> least;
    for (int n = 0; n < size[2]; ++n) {
        if (wanted)
            wanted->check();
        for (int m = 0; m < size[1]; ++m) {
            const int k = forward ? n : size[2] - 1 - n, j = forward ? m : size[1] - 1 - m;
            sweepRow(rowAt(j, k),
                     {rowAt(j + back, k), rowAt(j - 1, k + back), rowAt(j, k + back), rowAt(j + 1, k + back)}, size[0],
                     forward, least);
        }
    }
}

}  // namespace

SightField::SightField(const InsideView& inside, const Progress* wanted) : grid_(inside.grid)
{
    for (std::size_t d = 0; d < 3; ++d)
        size_[d] = grid_.size[d] + 1;
    std::vector<std::uint8_t> steps(std::size_t(size_[0]) * std::size_t(size_[1]) * std::size_t(size_[2]));
    tbb::parallel_for(tbb::blocked_range<int>(0, size_[2]), [&](const auto& slices) {
        for (int k = slices.begin(); k < slices.end(); ++k)
            for (int j = 0; j < size_[1]; ++j)
                classifyRow(inside, j, k, steps);
    });
    sweep(steps, size_, true, wanted);
    sweep(steps, size_, false, wanted);
    fillVoxelBlocks(inside);
    if (wanted)
        wanted->check();
    fillCubeBlocks(inside, steps);
}

void SightField::fillVoxelBlocks(const InsideView& inside)
{
    voxel_blocks_ = BlockGrid({grid_.size[0], grid_.size[1], grid_.size[2]});
    inside_.assign(voxel_blocks_.count(), 0);
    std::size_t n = 0;
    for (int k = 0; k < grid_.size[2]; ++k)
        for (int j = 0; j < grid_.size[1]; ++j)
            for (int i = 0; i < grid_.size[0]; ++i, ++n)
                if (inside.voxels[n] != kOutside)
                    inside_[voxel_blocks_.blockOf({i, j, k})] |= std::uint64_t(1) << BlockGrid::placeOf({i, j, k});
}

void SightField::fillCubeBlocks(const InsideView& inside, const std::vector<std::uint8_t>& steps)
{
    cube_blocks_ = BlockGrid(size_);
    steps_.assign(cube_blocks_.count() * BlockGrid::kPlaces, 0);
    tbb::parallel_for(tbb::blocked_range<int>(0, size_[2]), [&](const auto& slices) {
        std::size_t n = std::size_t(slices.begin()) * std::size_t(size_[0]) * std::size_t(size_[1]);
        for (int k = slices.begin(); k < slices.end(); ++k)
            for (int j = 0; j < size_[1]; ++j)
                for (int i = 0; i < size_[0]; ++i, ++n) {
                    // Where a cube's corners are alike, any of them tells what they are.
                    const bool open = grid_.contains({i, j, k}) && inside.voxels[grid_.offset({i, j, k})] != kOutside;
                    steps_[cube_blocks_.elementOf({i, j, k})] = std::int8_t(open ? int(steps[n]) : -int(steps[n]));
                }
    });
}

// 0 in the wall, the most elsewhere.
void SightField::classifyRow(const InsideView& inside, int j, int k, std::vector<std::uint8_t>& steps) const
{
    const auto voxelRow = [&](int v, int w) -> const std::uint8_t* {
        if (v < 0 || v >= grid_.size[1] || w < 0 || w >= grid_.size[2])
            return nullptr;
        return inside.voxels.data() + grid_.offset({0, v, w});
    };
    const std::array<const std::uint8_t*, 4> rows{voxelRow(j - 1, k - 1), voxelRow(j, k - 1), voxelRow(j - 1, k),
                                                  voxelRow(j, k)};
    const auto insideAt = [&](int i) {
        int count = 0;
        for (const std::uint8_t* row : rows)
            count += row && i >= 0 && i < grid_.size[0] && row[i] != kOutside ? 1 : 0;
        return count;
    };
    const std::size_t first = std::size_t(size_[0]) * (std::size_t(j) + std::size_t(size_[1]) * std::size_t(k));
    int before = 0;
    for (int i = 0; i < size_[0]; ++i) {
        const int after = insideAt(i), corners = before + after;
        steps[first + std::size_t(i)] = corners == 0 || corners == 8 ? kMost : 0;
        before = after;
    }
}

}  // namespace vicon::viewer

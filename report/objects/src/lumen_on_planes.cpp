#include "lumen_on_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicon::report {
namespace {

constexpr int kBlock = 8;
constexpr double kRounding = 1e-6;  // voxels

using Position = std::array<double, 3>;  // in voxels

Position positionOf(const Grid& grid, Point3 point_mm)
{
    const ContinuousIndex3 at = grid.continuousIndexAt(point_mm);
    return {at.i, at.j, at.k};
}

Position stepOf(const Grid& grid, Vector3 step_mm)
{
    return {dot(step_mm, grid.axis[0]) / grid.spacing_mm[0], dot(step_mm, grid.axis[1]) / grid.spacing_mm[1],
            dot(step_mm, grid.axis[2]) / grid.spacing_mm[2]};
}

Position along(const Position& start, const Position& step, int steps)
{
    return {start[0] + step[0] * steps, start[1] + step[1] * steps, start[2] + step[2] * steps};
}

/// The columns whose places lie in a box, for a row from `start` with `step`: [first, second).
std::pair<int, int> columnsIn(const Position& start, const Position& step, int columns, const Position& least,
                              const Position& most)
{
    constexpr double kStill = 1e-9;
    double from = 0, to = columns - 1;
    for (int a = 0; a < 3; ++a) {
        if (std::abs(step[a]) < kStill) {
            if (start[a] < least[a] || start[a] > most[a])
                return {0, 0};
            continue;
        }
        const double enter = (least[a] - start[a]) / step[a], leave = (most[a] - start[a]) / step[a];
        from = std::max(from, std::min(enter, leave));
        to = std::min(to, std::max(enter, leave));
    }
    return from > to ? std::pair{0, 0} : std::pair{int(std::ceil(from)), int(std::floor(to)) + 1};
}

}  // namespace

LumenOnPlanes::LumenOnPlanes(const InsideView& inside) : inside_(inside)
{
    findExtent();
    sortBlocks();
}

void LumenOnPlanes::findExtent()
{
    const auto& size = inside_.grid.size;
    std::array<int, 3> least = size, most{-1, -1, -1};
    const std::uint8_t* voxel = inside_.voxels.data();
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j, voxel += size[0]) {
            const std::uint8_t* end = voxel + size[0];
            const std::uint8_t* first = std::find_if(voxel, end, [](std::uint8_t label) { return label != 0; });
            if (first == end)
                continue;
            const auto last = std::find_if(std::reverse_iterator(end), std::reverse_iterator(first),
                                           [](std::uint8_t label) { return label != 0; });
            least = {std::min(least[0], int(first - voxel)), std::min(least[1], j), std::min(least[2], k)};
            most = {std::max(most[0], int(last.base() - voxel) - 1), std::max(most[1], j), std::max(most[2], k)};
        }
    for (std::size_t a = 0; a < 3; ++a) {  // the border lies half a voxel outside
        least_[a] = least[a] - 1.0;
        most_[a] = most[a] + 1.0;
    }
}

void LumenOnPlanes::sortBlocks()
{
    const auto& size = inside_.grid.size;
    for (std::size_t a = 0; a < 3; ++a)
        block_count_[a] = (size[a] + kBlock - 1) / kBlock;
    blocks_.resize(std::size_t(block_count_[0]) * std::size_t(block_count_[1]) * std::size_t(block_count_[2]));
    auto block = blocks_.begin();
    for (int bk = 0; bk < block_count_[2]; ++bk)
        for (int bj = 0; bj < block_count_[1]; ++bj)
            for (int bi = 0; bi < block_count_[0]; ++bi)
                *block++ = blockAt({bi * kBlock, bj * kBlock, bk * kBlock});
}

LumenOnPlanes::Block LumenOnPlanes::blockAt(Index3 first) const
{
    const auto& size = inside_.grid.size;
    bool any = false, all = first.i + kBlock < size[0] && first.j + kBlock < size[1] && first.k + kBlock < size[2];
    const int columns = std::min(kBlock + 1, size[0] - first.i);
    for (int k = first.k; k <= std::min(first.k + kBlock, size[2] - 1); ++k)
        for (int j = first.j; j <= std::min(first.j + kBlock, size[1] - 1); ++j) {
            const std::uint8_t* row = &inside_.at({first.i, j, k});
            const auto in = std::count_if(row, row + columns, [](std::uint8_t label) { return label != 0; });
            any |= in > 0;
            all &= in == columns;
            if (any && !all)
                return Block::border;
        }
    return all ? Block::inside : any ? Block::border : Block::outside;
}

LumenOnPlanes::Run LumenOnPlanes::runAt(const Position& at, const Position& step) const
{
    std::array<int, 3> block{};
    double columns = std::numeric_limits<int>::max();
    for (std::size_t a = 0; a < 3; ++a) {
        const int base = int(std::floor(at[a] + kRounding));
        if (base < 0 || base >= inside_.grid.size[a])
            return {Block::border, 1};
        block[a] = base / kBlock;
        if (step[a] > 0)
            columns = std::min(columns, ((block[a] + 1) * kBlock - 2 * kRounding - at[a]) / step[a]);
        else if (step[a] < 0)
            columns = std::min(columns, (block[a] * kBlock - at[a]) / step[a]);
    }
    const Block kind = blocks_[std::size_t(block[0]) +
                               std::size_t(block_count_[0]) *
                                   (std::size_t(block[1]) + std::size_t(block_count_[1]) * std::size_t(block[2]))];
    return {kind, 1 + std::max(0, int(columns))};
}

bool LumenOnPlanes::holds(const Position& at) const
{
    std::array<int, 3> base{}, last{};
    std::array<double, 3> part{};
    for (std::size_t a = 0; a < 3; ++a) {
        base[a] = int(std::floor(at[a] + kRounding));
        part[a] = at[a] - base[a];
        last[a] = part[a] < kRounding ? 0 : 1;
    }
    double share = 0;
    for (int dk = 0; dk <= last[2]; ++dk)
        for (int dj = 0; dj <= last[1]; ++dj)
            for (int di = 0; di <= last[0]; ++di)
                if (inside_.valueOr({base[0] + di, base[1] + dj, base[2] + dk}, 0) != 0)
                    share += (di ? part[0] : 1 - part[0]) * (dj ? part[1] : 1 - part[1]) * (dk ? part[2] : 1 - part[2]);
    return share >= 0.5 - kRounding;
}

std::vector<std::uint8_t> LumenOnPlanes::on(const ImagePlane& plane) const
{
    const Grid& grid = inside_.grid;
    const Position column_step = stepOf(grid, plane.along_row * plane.column_step_mm);
    std::vector<std::uint8_t> mask;
    for (int row = 0; row < plane.rows; ++row) {
        const Position start = positionOf(grid, plane.origin_mm + plane.along_column * (plane.row_step_mm * row));
        const auto [from, to] = columnsIn(start, column_step, plane.columns, least_, most_);
        for (int column = from; column < to;) {
            const auto [block, columns] = runAt(along(start, column_step, column), column_step);
            const int first = column;
            column = std::min(to, column + columns);
            if (block == Block::outside)
                continue;
            for (int n = first; n < column; ++n) {
                if (block == Block::border && !holds(along(start, column_step, n)))
                    continue;
                if (mask.empty())
                    mask.resize(std::size_t(plane.rows) * std::size_t(plane.columns));
                mask[std::size_t(row) * std::size_t(plane.columns) + std::size_t(n)] = 1;
            }
        }
    }
    return mask;
}

}  // namespace vicon::report

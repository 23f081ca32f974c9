#include "tissue/near_mask.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "vicon/core/fresh_memory.h"

namespace vicon::steps {
namespace {

/// Marks `reach` elements on both sides of every marked one of a row.
void widenRow(std::uint8_t* row, int length, int reach)
{
    int until = -1;  // marked as far as here by one to the left
    for (int i = 0; i < length; ++i) {
        if (row[i] == 1) {
            until = i + reach;
            for (int b = std::max(0, i - reach); b < i; ++b)
                row[b] = row[b] ? row[b] : std::uint8_t(2);
        } else if (i <= until) {
            row[i] = 2;
        }
    }
    std::transform(row, row + length, row, [](std::uint8_t v) { return std::uint8_t(v != 0); });
}

/// The maximum over `reach` rows before and behind, of `count` rows that lie `stride` apart.
void widenRows(std::uint8_t* first, int count, std::ptrdiff_t stride, int length, int reach)
{
    std::vector<std::uint8_t> kept(std::size_t(count) * std::size_t(length));
    std::vector<std::uint8_t> marked(std::size_t(count), 0);
    for (int n = 0; n < count; ++n) {
        std::copy_n(first + n * stride, length, &kept[std::size_t(n) * std::size_t(length)]);
        marked[std::size_t(n)] = std::any_of(first + n * stride, first + n * stride + length, [](auto v) { return v; });
    }
    for (int n = 0; n < count; ++n)
        for (int m = std::max(0, n - reach); m <= std::min(count - 1, n + reach); ++m) {
            if (m == n || !marked[std::size_t(m)])
                continue;
            std::uint8_t* row = first + n * stride;
            const std::uint8_t* other = &kept[std::size_t(m) * std::size_t(length)];
            for (int i = 0; i < length; ++i)
                row[i] |= other[i];
        }
}

}  // namespace

std::vector<std::uint8_t> nearMask(const InsideVolume& inside, std::uint8_t label, int reach)
{
    const auto [nx, ny, nz] = inside.grid.size;
    const std::ptrdiff_t slice = std::ptrdiff_t(nx) * ny;
    std::vector<std::uint8_t> mask;
    fillFresh(mask, inside.voxels.size(), std::uint8_t(0));
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        for (int j = 0; j < ny; ++j) {
            const std::uint8_t* from = &inside.voxels[inside.grid.offset({0, j, k})];
            std::uint8_t* row = &mask[std::size_t(k * slice + std::ptrdiff_t(j) * nx)];
            std::transform(from, from + nx, row, [label](std::uint8_t v) {
                return std::uint8_t(label == kOutside ? v != kOutside : v == label);
            });
            widenRow(row, nx, reach);
        }
        widenRows(&mask[std::size_t(k * slice)], ny, nx, nx, reach);
    });
    tbb::parallel_for(0, ny, [&, nx = nx, nz = nz](int j) {
        widenRows(&mask[std::size_t(j) * std::size_t(nx)], nz, slice, nx, reach);
    });
    return mask;
}

}  // namespace vicon::steps

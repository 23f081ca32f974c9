#include "tissue/near_mask.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "grid/byte_rows.h"
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

/// Rows that lie one behind the other, and which of them hold a mark.
struct Rows {
    std::uint8_t* first;
    int count;
    std::ptrdiff_t apart;
    std::uint8_t* is_marked;
    std::ptrdiff_t marks_apart;
};

/// Marks what is marked up to `reach` rows before or behind.
void widenRows(const Rows& rows, int length, int reach)
{
    std::vector<int> marked;
    std::vector<std::uint8_t> kept;
    for (int n = 0; n < rows.count; ++n)
        if (rows.is_marked[n * rows.marks_apart]) {
            marked.push_back(n);
            kept.insert(kept.end(), rows.first + n * rows.apart, rows.first + n * rows.apart + length);
        }
    for (std::size_t at = 0; at < marked.size(); ++at) {
        const std::uint8_t* from = &kept[at * std::size_t(length)];
        const int n = marked[at];
        for (int m = std::max(0, n - reach); m <= std::min(rows.count - 1, n + reach); ++m) {
            std::uint8_t* to = rows.first + m * rows.apart;
            for (int i = 0; i < length; ++i)
                to[i] |= from[i];
            rows.is_marked[m * rows.marks_apart] = 1;
        }
    }
}

bool holds(const std::uint8_t* row, int length, std::uint8_t label)
{
    return label == kOutside ? firstOther(row, 0, length, kOutside) < length
                             : std::memchr(row, label, std::size_t(length)) != nullptr;
}

}  // namespace

std::vector<std::uint8_t> nearMask(const InsideVolume& inside, std::uint8_t label, int reach)
{
    const auto [nx, ny, nz] = inside.grid.size;
    const std::ptrdiff_t slice = std::ptrdiff_t(nx) * ny;
    std::vector<std::uint8_t> mask, is_marked(std::size_t(ny) * std::size_t(nz), 0);
    fillFresh(mask, inside.voxels.size(), std::uint8_t(0));
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        std::uint8_t* first_marked = &is_marked[std::size_t(k) * std::size_t(ny)];
        for (int j = 0; j < ny; ++j) {
            const std::uint8_t* from = &inside.voxels[inside.grid.offset({0, j, k})];
            if (!holds(from, nx, label))
                continue;
            std::uint8_t* row = &mask[std::size_t(k * slice + std::ptrdiff_t(j) * nx)];
            std::transform(from, from + nx, row, [label](std::uint8_t v) {
                return std::uint8_t(label == kOutside ? v != kOutside : v == label);
            });
            widenRow(row, nx, reach);
            first_marked[j] = 1;
        }
        widenRows({&mask[std::size_t(k * slice)], ny, nx, first_marked, 1}, nx, reach);
    });
    tbb::parallel_for(0, ny, [&, nx = nx, ny = ny, nz = nz](int j) {
        widenRows({&mask[std::size_t(j) * std::size_t(nx)], nz, slice, &is_marked[std::size_t(j)], ny}, nx, reach);
    });
    return mask;
}

}  // namespace vicon::steps

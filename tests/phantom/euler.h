#pragma once

#include <cstddef>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::phantom {

/// Euler number of the union of closed cubes, counted cell by cell: corners - edges + faces - cubes. Slow and plain, to
/// hold the room's own against.
inline long countedEulerNumber(const InsideVolume& volume)
{
    const auto [nx, ny, nz] = volume.grid.size;
    const std::size_t mx = 2 * std::size_t(nx) + 1, my = 2 * std::size_t(ny) + 1, mz = 2 * std::size_t(nz) + 1;
    std::vector<bool> cell(mx * my * mz, false);
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                if (volume.at({i, j, k}) != kOutside)
                    for (int c = 0; c < 27; ++c)
                        cell[std::size_t(2 * i + c % 3) +
                             mx * (std::size_t(2 * j + c / 3 % 3) + my * std::size_t(2 * k + c / 9))] = true;
    long euler = 0;
    for (std::size_t n = 0; n < cell.size(); ++n)
        if (cell[n])
            euler += ((n % mx) % 2 + (n / mx % my) % 2 + (n / (mx * my)) % 2) % 2 == 0 ? 1 : -1;
    return euler;
}

/// Number of sets of voxels that hang together over faces.
inline int countedPieces(const InsideVolume& volume)
{
    std::vector<bool> seen(volume.voxels.size(), false);
    int pieces = 0;
    std::vector<std::size_t> todo;
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        if (volume.voxels[n] == kOutside || seen[n])
            continue;
        ++pieces;
        seen[n] = true;
        todo.push_back(n);
        while (!todo.empty()) {
            const Index3 v = volume.grid.indexOf(todo.back());
            todo.pop_back();
            for (const Index3 w : {Index3{v.i - 1, v.j, v.k},
                                   {v.i + 1, v.j, v.k},
                                   {v.i, v.j - 1, v.k},
                                   {v.i, v.j + 1, v.k},
                                   {v.i, v.j, v.k - 1},
                                   {v.i, v.j, v.k + 1}})
                if (volume.valueOr(w, kOutside) != kOutside && !seen[volume.grid.offset(w)]) {
                    seen[volume.grid.offset(w)] = true;
                    todo.push_back(volume.grid.offset(w));
                }
        }
    }
    return pieces;
}

}  // namespace vicon::phantom

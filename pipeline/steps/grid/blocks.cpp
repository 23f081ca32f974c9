#include "grid/blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace vicon::steps {
namespace {

using Mask = Volume<std::uint8_t>;

Grid coarseGrid(const Grid& grid, int factor)
{
    Grid coarse = grid;
    for (std::size_t a = 0; a < 3; ++a) {
        coarse.size[a] = (grid.size[a] + factor - 1) / factor;
        coarse.spacing_mm[a] = grid.spacing_mm[a] * factor;
    }
    const double shift = (factor - 1) / 2.0;
    coarse.origin_mm = grid.pointAt(ContinuousIndex3{shift, shift, shift});
    return coarse;
}

/// Minimum (erosion) or maximum (dilation) over 3 x 3 x 3 voxels, axis by axis; the border counts as its neighbour.
Mask box(const Mask& in, bool erode)
{
    Mask from = in, to = in;
    const auto& size = in.grid.size;
    const std::array<std::size_t, 3> stride{1, std::size_t(size[0]), std::size_t(size[0]) * std::size_t(size[1])};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        tbb::parallel_for(0, size[2], [&](int k) {
            for (int j = 0; j < size[1]; ++j)
                for (int i = 0; i < size[0]; ++i) {
                    const std::size_t n = in.grid.offset({i, j, k});
                    const int at = axis == 0 ? i : axis == 1 ? j : k;
                    const std::uint8_t before = from.voxels[at > 0 ? n - stride[axis] : n];
                    const std::uint8_t after = from.voxels[at + 1 < size[axis] ? n + stride[axis] : n];
                    const std::uint8_t own = from.voxels[n];
                    to.voxels[n] = erode ? std::min({before, own, after}) : std::max({before, own, after});
                }
        });
        std::swap(from, to);
    }
    return from;
}

}  // namespace

HuVolume meanOfBlocks(const HuVolume& volume, int factor)
{
    HuVolume coarse(coarseGrid(volume.grid, factor));
    const int nx = volume.grid.size[0], ny = volume.grid.size[1], nz = volume.grid.size[2];
    tbb::parallel_for(0, coarse.grid.size[2], [&](int ck) {
        const auto cx = std::size_t(coarse.grid.size[0]);
        std::vector<std::int64_t> sum(cx * std::size_t(coarse.grid.size[1]), 0);
        const int k_end = std::min(nz, (ck + 1) * factor);
        for (int k = ck * factor; k < k_end; ++k)
            for (int j = 0; j < ny; ++j) {
                const std::int16_t* row = &volume.voxels[volume.grid.offset({0, j, k})];
                std::int64_t* out = &sum[cx * std::size_t(j / factor)];
                for (int ci = 0; ci < int(cx); ++ci) {
                    std::int32_t s = 0;
                    for (int i = ci * factor, end = std::min(nx, i + factor); i < end; ++i)
                        s += row[i];
                    out[ci] += s;
                }
            }
        for (int cj = 0; cj < coarse.grid.size[1]; ++cj)
            for (int ci = 0; ci < int(cx); ++ci) {
                const int count = (std::min(nx, (ci + 1) * factor) - ci * factor) *
                                  (std::min(ny, (cj + 1) * factor) - cj * factor) * (k_end - ck * factor);
                coarse.at({ci, cj, ck}) = std::int16_t(sum[std::size_t(ci) + cx * std::size_t(cj)] / count);
            }
    });
    return coarse;
}

Volume<std::uint8_t> erodedByBox(const Volume<std::uint8_t>& mask)
{
    return box(mask, true);
}

Volume<std::uint8_t> dilatedByBox(const Volume<std::uint8_t>& mask)
{
    return box(mask, false);
}

}  // namespace vicon::steps

#include "grid/blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
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
    const auto along = [&](auto rowAt) {
        tbb::parallel_for(0, size[2], [&](int k) {
            for (int j = 0; j < size[1]; ++j)
                rowAt(j, k);
        });
        std::swap(from, to);
    };
    const auto threeOf = [&](const std::uint8_t* before, const std::uint8_t* own, const std::uint8_t* after,
                             std::uint8_t* out, int count) {
        for (int i = 0; erode && i < count; ++i)
            out[i] = std::min(std::min(before[i], own[i]), after[i]);
        for (int i = 0; !erode && i < count; ++i)
            out[i] = std::max(std::max(before[i], own[i]), after[i]);
    };
    along([&](int j, int k) {
        const std::uint8_t* own = &from.at({0, j, k});
        const int nx = size[0], last = nx - 1;
        threeOf(own, own, own + std::min(1, last), &to.at({0, j, k}), 1);
        threeOf(own, own + 1, own + 2, &to.at({0, j, k}) + 1, nx - 2);
        threeOf(own + std::max(0, last - 1), own + last, own + last, &to.at({last, j, k}), 1);
    });
    along([&](int j, int k) {
        threeOf(&from.at({0, std::max(0, j - 1), k}), &from.at({0, j, k}),
                &from.at({0, std::min(size[1] - 1, j + 1), k}), &to.at({0, j, k}), size[0]);
    });
    along([&](int j, int k) {
        threeOf(&from.at({0, j, std::max(0, k - 1)}), &from.at({0, j, k}),
                &from.at({0, j, std::min(size[2] - 1, k + 1)}), &to.at({0, j, k}), size[0]);
    });
    return from;
}

}  // namespace

HuVolume meanOfBlocks(const HuVolume& volume, int factor)
{
    HuVolume coarse(coarseGrid(volume.grid, factor));
    const int nx = volume.grid.size[0], ny = volume.grid.size[1], nz = volume.grid.size[2];
    tbb::parallel_for(0, coarse.grid.size[2], [&](int ck) {
        // Row upon row is what vectors add; a row's blocks are added up last.
        std::vector<std::int32_t> sums(static_cast<std::size_t>(nx));
        const int k_end = std::min(nz, (ck + 1) * factor);
        for (int cj = 0; cj < coarse.grid.size[1]; ++cj) {
            const int j_end = std::min(ny, (cj + 1) * factor);
            std::fill(sums.begin(), sums.end(), 0);
            for (int k = ck * factor; k < k_end; ++k)
                for (int j = cj * factor; j < j_end; ++j) {
                    const std::int16_t* row = &volume.voxels[volume.grid.offset({0, j, k})];
                    std::transform(sums.begin(), sums.end(), row, sums.begin(), std::plus<std::int32_t>());
                }
            const int rows = (j_end - cj * factor) * (k_end - ck * factor);
            std::int16_t* out = &coarse.at({0, cj, ck});
            for (int i = 0; i < nx; i += factor) {
                const int end = std::min(nx, i + factor);
                *out++ =
                    std::int16_t(std::accumulate(&sums[std::size_t(i)], sums.data() + end, 0) / ((end - i) * rows));
            }
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

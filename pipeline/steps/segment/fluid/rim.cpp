#include "segment/fluid/rim.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "grid/byte_rows.h"

namespace vicon::steps {
namespace {

/// Whether a voxel has a neighbour whose label satisfies `wanted`; over faces, or over edges and corners as well. Its
/// own loop, not forEachOverFaces(): it is asked of every voxel of fluid, layer by layer, and ends at the first.
template <class Wanted>
bool touches(const InsideVolume& labels, std::size_t n, bool all, Wanted wanted)
{
    const auto [nx, ny, nz] = labels.grid.size;
    const Index3 v = labels.grid.indexOf(n);
    const std::ptrdiff_t row = nx, slice = row * ny;
    const std::uint8_t* at = &labels.voxels[n];
    const bool within = v.i > 0 && v.j > 0 && v.k > 0 && v.i + 1 < nx && v.j + 1 < ny && v.k + 1 < nz;
    // Most voxels lie within the grid, and most that touch at all touch over a face.
    if (within && (wanted(at[-1]) || wanted(at[1]) || wanted(at[-row]) || wanted(at[row]) || wanted(at[-slice]) ||
                   wanted(at[slice])))
        return true;
    if (within && !all)
        return false;
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const int apart = std::abs(i) + std::abs(j) + std::abs(k);
                if (apart == 0 || (apart > 1 && !all) ||
                    (!within && !labels.grid.contains({v.i + i, v.j + j, v.k + k})))
                    continue;
                if (wanted(at[i + j * row + k * slice]))
                    return true;
            }
    return false;
}

/// Layers in turn over faces and over all neighbours grow like a ball rather than a cube or an octahedron.
bool overAll(int layer)
{
    return layer % 2 == 1;
}

/// @param label not kOutside
std::vector<std::size_t> voxelsOf(const InsideVolume& labels, std::uint8_t label)
{
    const auto slice = std::size_t(labels.grid.size[0]) * std::size_t(labels.grid.size[1]);
    std::vector<std::vector<std::size_t>> slices(std::size_t(labels.grid.size[2]), std::vector<std::size_t>{});
    tbb::parallel_for(std::size_t(0), slices.size(), [&](std::size_t k) {
        const std::size_t end = (k + 1) * slice;
        const auto next = [&](std::size_t n) { return firstOther(labels.voxels.data(), n, end, kOutside); };
        for (std::size_t n = next(k * slice); n < end; n = next(n + 1))
            if (labels.voxels[n] == label)
                slices[k].push_back(n);
    });
    std::vector<std::size_t> all;
    for (auto& s : slices) {
        all.insert(all.end(), s.begin(), s.end());
        s = {};
    }
    return all;
}

/// Moves the voxels of `candidates` that touch what is wanted to another label, all at once; the others stay.
template <class Wanted>
void relabelLayer(InsideVolume& labels, std::vector<std::size_t>& candidates, std::uint8_t to, bool all, Wanted wanted)
{
    std::vector<std::uint8_t> hit(candidates.size(), 0);
    tbb::parallel_for(std::size_t(0), candidates.size() / 4096 + 1, [&](std::size_t chunk) {
        for (std::size_t c = chunk * 4096; c < std::min(candidates.size(), (chunk + 1) * 4096); ++c)
            hit[c] = touches(labels, candidates[c], all, wanted) ? 1 : 0;
    });
    std::size_t kept = 0;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        if (hit[c])
            labels.voxels[candidates[c]] = to;
        else
            candidates[kept++] = candidates[c];
    }
    candidates.resize(kept);
}

}  // namespace

int rimLayers(const Grid& grid, double width_mm)
{
    return std::max(1, int(std::lround(width_mm / grid.spacing_mm[0])));
}

void markFluidRim(InsideVolume& labels, int layers)
{
    std::vector<std::size_t> fluid = voxelsOf(labels, kFluid);
    for (int layer = 0; layer < layers; ++layer)
        relabelLayer(labels, fluid, kRim, overAll(layer),
                     [layer](std::uint8_t label) { return layer == 0 ? label == kOutside : label == kRim; });
}

void restoreFluidRim(InsideVolume& labels, int layers)
{
    std::vector<std::size_t> rim = voxelsOf(labels, kRim);
    for (int layer = 0; layer <= layers; ++layer)
        relabelLayer(labels, rim, kFluid, overAll(layer),
                     [](std::uint8_t label) { return label == kGas || label == kFluid; });
    for (const std::size_t n : rim)
        labels.voxels[n] = kOutside;
}

}  // namespace vicon::steps

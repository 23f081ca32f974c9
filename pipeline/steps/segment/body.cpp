#include "segment/body.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/run_labels.h"
#include "segment/constants.h"

namespace vicon::steps {
namespace {

// 2.7 mm: blocks of 4 at the usual 0.68 mm; an opening by one block then removes table tops and blankets, not
// limbs.
constexpr double kCoarse_mm = 2.7;

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

/// Mean density of each block.
Volume<std::int16_t> shrink(const HuVolume& volume, int factor)
{
    Volume<std::int16_t> coarse(coarseGrid(volume.grid, factor));
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

Mask largestComponent(const Mask& mask)
{
    const auto scan = [&](int j, int k, std::vector<VoxelRun>& runs) {
        const std::uint8_t* row = &mask.voxels[mask.grid.offset({0, j, k})];
        for (int i = 0; i < mask.grid.size[0];) {
            const int begin = i;
            while (i < mask.grid.size[0] && row[i])
                ++i;
            if (i > begin)
                runs.push_back({begin, i, 0, 0});
            else
                ++i;
        }
    };
    const RunLabels labels = labelRuns(mask.grid.size, scan, Neighbours::faces);
    Mask out(mask.grid);
    if (labels.components.empty())
        return out;
    const auto largest =
        std::max_element(labels.components.begin(), labels.components.end(),
                         [](const RunComponent& a, const RunComponent& b) { return a.voxels < b.voxels; });
    const auto wanted = std::uint32_t(largest - labels.components.begin());
    labels.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (run.label == wanted)
            std::fill_n(&out.at({run.begin, j, k}), run.end - run.begin, std::uint8_t(1));
    });
    return out;
}

/// Everything in an axial slice that the slice's border cannot reach without crossing the body.
void fillSlice(Mask& mask, int k)
{
    const int nx = mask.grid.size[0], ny = mask.grid.size[1];
    std::vector<Index3> stack;
    std::vector<std::uint8_t> outside(std::size_t(nx) * std::size_t(ny), 0);
    const auto visit = [&](int i, int j) {
        if (i < 0 || j < 0 || i >= nx || j >= ny || mask.at({i, j, k}))
            return;
        std::uint8_t& seen = outside[std::size_t(i) + std::size_t(nx) * std::size_t(j)];
        if (!seen) {
            seen = 1;
            stack.push_back({i, j, k});
        }
    };
    for (int i = 0; i < nx; ++i) {
        visit(i, 0);
        visit(i, ny - 1);
    }
    for (int j = 0; j < ny; ++j) {
        visit(0, j);
        visit(nx - 1, j);
    }
    while (!stack.empty()) {
        const Index3 v = stack.back();
        stack.pop_back();
        visit(v.i - 1, v.j);
        visit(v.i + 1, v.j);
        visit(v.i, v.j - 1);
        visit(v.i, v.j + 1);
    }
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            mask.at({i, j, k}) = outside[std::size_t(i) + std::size_t(nx) * std::size_t(j)] ? 0 : 1;
}

void measureBox(Body& body)
{
    const Grid& grid = body.inside.grid;
    Index3 lower{1 << 30, 1 << 30, 1 << 30}, upper{-1, -1, -1};
    for (std::size_t n = 0; n < body.inside.voxels.size(); ++n)
        if (body.inside.voxels[n]) {
            const Index3 v = grid.indexOf(n);
            lower = {std::min(lower.i, v.i), std::min(lower.j, v.j), std::min(lower.k, v.k)};
            upper = {std::max(upper.i, v.i), std::max(upper.j, v.j), std::max(upper.k, v.k)};
        }
    if (upper.i < 0)
        return;
    const Point3 a = grid.pointAt(lower), b = grid.pointAt(upper);
    body.lower_mm = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    body.upper_mm = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

}  // namespace

Body findBody(const HuVolume& volume, Progress& progress)
{
    Body body;
    body.factor = std::clamp(int(std::lround(kCoarse_mm / volume.grid.spacing_mm[0])), 1, 8);
    body.mean_hu = shrink(volume, body.factor);
    progress.check();
    Mask mask(body.mean_hu.grid);
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        mask.voxels[n] = body.mean_hu.voxels[n] > kBody_hu ? 1 : 0;
    mask = largestComponent(box(box(mask, true), false));
    tbb::parallel_for(0, mask.grid.size[2], [&](int k) { fillSlice(mask, k); });
    body.inside = box(mask, true);
    measureBox(body);
    return body;
}

}  // namespace vicon::steps

#include "segment/given/given_labels.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "grid/allocate.h"
#include "grid/neighbours.h"
#include "segment/constants.h"
#include "segment/fluid/fluid.h"
#include "segment/given/on_grid.h"
#include "segment/lumen.h"
#include "segment/points.h"

namespace vicon::steps {
namespace {

constexpr std::uint8_t kUndecided = 9;  // a definition: none of the labels of an InsideVolume

/// What a density alone says.
std::uint8_t labelOf(std::int16_t hu, double wall_hu, double fluid_hu)
{
    if (hu < wall_hu)
        return kGas;
    return hu >= fluid_hu ? std::uint8_t(kFluid) : kUndecided;
}

/// The offset in `grid` of a voxel of a part of it that begins at `low`.
std::size_t offsetIn(const Grid& grid, Index3 low, Index3 v)
{
    return grid.offset({v.i + low.i, v.j + low.j, v.k + low.k});
}

InsideVolume labelByDensity(const HuVolume& volume, const InsideVolume& lumen, const SegmentOptions& options)
{
    auto labels = makeVolume<std::uint8_t>(volume.grid);
    const Index3 low = volume.grid.indexAt(lumen.grid.origin_mm);
    const double fluid_hu = fluidFrom_hu(options);
    for (std::size_t n = 0; n < lumen.voxels.size(); ++n) {
        if (!lumen.voxels[n])
            continue;
        const std::size_t at = offsetIn(volume.grid, low, lumen.grid.indexOf(n));
        if (const std::int16_t hu = volume.voxels[at]; hu != kPaddingHu)
            labels.voxels[at] = labelOf(hu, options.densities.wall_hu, fluid_hu);
    }
    return labels;
}

/// One layer of what is undecided takes the labels of what it touches.
void decideLayer(std::vector<std::size_t>& edge, InsideVolume& labels)
{
    std::vector<std::pair<std::size_t, std::uint8_t>> decided;
    for (const std::size_t n : edge)
        forEachOverFaces(labels.grid, n, [&](std::size_t m) {
            if (labels.voxels[m] == kUndecided)
                decided.emplace_back(m, labels.voxels[n]);
        });
    edge.clear();
    for (const auto& [voxel, label] : decided)
        if (std::exchange(labels.voxels[voxel], label) == kUndecided)
            edge.push_back(voxel);
}

}  // namespace

double fluidFrom_hu(const SegmentOptions& options)
{
    return (options.densities.tissue_hu + options.fluid_above_hu) / 2;
}

GivenLabels labelGiven(const HuVolume& volume, const InsideVolume& given, const SegmentOptions& options,
                       Progress& progress)
{
    const InsideVolume lumen = onGrid(given, volume.grid);
    progress.check();
    GivenLabels out{labelByDensity(volume, lumen, options)};
    std::vector<std::size_t> edge;
    for (std::size_t n = 0; n < out.labels.voxels.size(); ++n)
        if (out.labels.voxels[n] == kGas || out.labels.voxels[n] == kFluid)
            edge.push_back(n);
    const int layers = std::max(1, int(kBlurredEdge_mm / volume.grid.spacing_mm[0]));
    for (int layer = 0; layer < layers; ++layer)
        decideLayer(edge, out.labels);
    std::size_t dense = 0;
    for (std::uint8_t& label : out.labels.voxels)
        if (label == kUndecided) {
            label = kOutside;
            ++dense;
        }
    out.dense_ml = double(dense) * volume.grid.voxelVolume_mm3() / 1000;
    return out;
}

void addGasAndFluidAt(const HuVolume& volume, const Body& body, Point3 point, const SegmentOptions& options,
                      InsideVolume& labels)
{
    const RunLabels gas = findGas(volume, body, options.gas_below_hu);
    if (const std::vector<int> at = componentsAt(gas, volume.grid, {point}); !at.empty()) {
        auto added = makeVolume<std::uint8_t>(volume.grid);
        gas.forEachRun([&](const VoxelRun& run, int j, int k) {
            if (std::find(at.begin(), at.end(), int(run.label)) != at.end())
                std::fill_n(&added.at({run.begin, j, k}), run.end - run.begin, std::uint8_t(kGas));
        });
        growToWall(volume, options.densities.wall_hu, added);
        for (std::size_t n = 0; n < added.voxels.size(); ++n)
            if (added.voxels[n] && !labels.voxels[n])
                labels.voxels[n] = kGas;
    }
    addFluidAt(volume, point, {options.fluid_above_hu, options.densities}, labels);
}

}  // namespace vicon::steps

#include "segment/fluid/fluid.h"

#include <algorithm>
#include <cmath>

#include "grid/meniscus.h"
#include "segment/fluid/layer.h"
#include "segment/fluid/levels.h"
#include "segment/fluid/specks.h"
#include "vicon/steps/noise.h"

namespace vicon::steps {
namespace {

Index3 below(Index3 v, Down down, int steps)
{
    (down.axis == 0 ? v.i : down.axis == 1 ? v.j : v.k) += down.sign * steps;
    return v;
}

/// Marks everything above `half_hu` that the stacked voxels reach over faces.
void flood(const HuVolume& volume, double half_hu, InsideVolume& labels, std::vector<std::size_t>& stack)
{
    const auto [nx, ny, nz] = labels.grid.size;
    const std::array<std::ptrdiff_t, 3> stride{1, nx, std::ptrdiff_t(nx) * ny};
    while (!stack.empty()) {
        const std::size_t n = stack.back();
        stack.pop_back();
        const Index3 v = labels.grid.indexOf(n);
        const std::array<int, 3> at{v.i, v.j, v.k};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                const int to = at[axis] + step;
                if (to < 0 || to >= labels.grid.size[axis])
                    continue;
                const std::size_t m = std::size_t(std::ptrdiff_t(n) + step * stride[axis]);
                if (labels.voxels[m] || volume.voxels[m] < half_hu)
                    continue;
                labels.voxels[m] = kFluid;
                stack.push_back(m);
            }
    }
}

}  // namespace

FluidResult addTaggedFluid(const HuVolume& volume, Vector3 gravity, const FluidDensities& densities,
                           InsideVolume& labels, Progress& progress)
{
    const Down down = downFor(labels.grid, gravity);
    FluidResult result;
    result.noise_hu = softTissueNoise(volume);
    std::vector<ContactPatch> patches = findFluidLevels(volume, down, densities, result.noise_hu, labels);
    progress.check();
    // Lowest threshold first: what a higher one would reach from a voxel already taken has then been taken too, so each
    // voxel is visited once and the order of the levels does not matter.
    std::stable_sort(patches.begin(), patches.end(),
                     [](const ContactPatch& a, const ContactPatch& b) { return a.density_hu < b.density_hu; });
    std::vector<std::size_t> stack;
    for (const ContactPatch& patch : patches) {
        const double half_hu = (patch.density_hu + densities.tissue_hu) / 2;
        FluidLevel level{patch.density_hu, 0, {}};
        Vector3 sum;
        for (const Contact& contact : patch.contacts) {
            const Index3 v = below(contact.gas, down, contact.steps);
            sum += labels.grid.pointAt(v) - Point3{};
            std::uint8_t& label = labels.at(v);
            if (!label && volume.at(v) >= half_hu) {
                label = kFluid;
                stack.push_back(labels.grid.offset(v));
            }
        }
        flood(volume, half_hu, labels, stack);
        level.centre_mm = Point3{} + sum / double(patch.contacts.size());
        level.area_mm2 = double(patch.contacts.size()) * labels.grid.voxelVolume_mm3() /
                         labels.grid.spacing_mm[std::size_t(down.axis)];
        result.levels.push_back(level);
        progress.check();
    }
    closeFluidLayer(volume, down, patches, densities.tissue_hu, labels);
    // Where noise cannot have made them, holes are what is left of a wall between two pools, and keep them apart.
    if (std::any_of(patches.begin(), patches.end(), [](const ContactPatch& patch) { return patch.noisy; }))
        fillFluidSpecks(labels);
    smoothAtMeniscus(labels);
    result.voxels = std::size_t(std::count(labels.voxels.begin(), labels.voxels.end(), std::uint8_t(kFluid)));
    return result;
}

void addFluidAt(const HuVolume& volume, Point3 point, const FluidDensities& densities, InsideVolume& labels)
{
    const Index3 v = volume.grid.indexAt(point);
    if (!volume.grid.contains(v) || labels.at(v) != kOutside)
        return;
    double sum = 0;
    int count = 0;
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                if (const Index3 n{v.i + i, v.j + j, v.k + k}; volume.grid.contains(n)) {
                    sum += volume.at(n);
                    ++count;
                }
    const double density_hu = sum / count;
    if (density_hu < densities.fluid_above_hu)
        return;
    labels.at(v) = kFluid;
    std::vector<std::size_t> stack{labels.grid.offset(v)};
    flood(volume, (density_hu + densities.tissue_hu) / 2, labels, stack);
}

}  // namespace vicon::steps

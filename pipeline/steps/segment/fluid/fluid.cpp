#include "segment/fluid/fluid.h"

#include <algorithm>
#include <cmath>

#include "grid/meniscus.h"
#include "grid/neighbours.h"
#include "segment/fluid/layer.h"
#include "segment/fluid/levels.h"
#include "segment/fluid/runaway.h"
#include "segment/fluid/specks.h"
#include "vicon/steps/noise.h"

namespace vicon::steps {
namespace {

Index3 below(Index3 v, Down down, int steps)
{
    (down.axis == 0 ? v.i : down.axis == 1 ? v.j : v.k) += down.sign * steps;
    return v;
}

/// Marks everything above `half_hu` that the voxels of `front` reach over faces.
void flood(const HuVolume& volume, double half_hu, InsideVolume& labels, std::vector<std::size_t> front)
{
    floodOverFaces(labels.grid, std::move(front), [&](std::size_t n) {
        if (labels.voxels[n] || volume.voxels[n] < half_hu)
            return false;
        labels.voxels[n] = kFluid;
        return true;
    });
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
    for (const ContactPatch& patch : patches) {
        std::vector<std::size_t> front;
        const double half_hu = (patch.density_hu + densities.wall.tissue_hu) / 2;
        FluidLevel level{patch.density_hu, 0, {}};
        Vector3 sum;
        for (const Contact& contact : patch.contacts) {
            const Index3 v = below(contact.gas, down, contact.steps);
            sum += labels.grid.pointAt(v) - Point3{};
            std::uint8_t& label = labels.at(v);
            if (!label && volume.at(v) >= half_hu) {
                label = kFluid;
                front.push_back(labels.grid.offset(v));
            }
        }
        flood(volume, half_hu, labels, std::move(front));
        level.centre_mm = Point3{} + sum / double(patch.contacts.size());
        level.area_mm2 = double(patch.contacts.size()) * labels.grid.voxelVolume_mm3() /
                         labels.grid.spacing_mm[std::size_t(down.axis)];
        result.levels.push_back(level);
        progress.check();
    }
    result.runaway_ml = cutRunaways(volume, down, patches, labels);
    closeFluidLayer(volume, down, patches, densities.wall.tissue_hu, labels);
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
    forEachInCube(v, 1, [&](Index3 n) {
        if (volume.grid.contains(n)) {
            sum += volume.at(n);
            ++count;
        }
    });
    const double density_hu = sum / count;
    if (density_hu < densities.fluid_above_hu)
        return;
    labels.at(v) = kFluid;
    flood(volume, (density_hu + densities.wall.tissue_hu) / 2, labels, {labels.grid.offset(v)});
}

}  // namespace vicon::steps

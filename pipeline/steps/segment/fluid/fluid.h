#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// Densities by which fluid is told from the wall.
struct FluidDensities {
    double fluid_above_hu = 0;  ///< tagged fluid has at least this density
    WallDensities wall;
};

/// A flat surface between gas and tagged fluid.
struct FluidLevel {
    double density_hu = 0;  ///< of the fluid below it
    double area_mm2 = 0;
    Point3 centre_mm;
};

struct FluidResult {
    std::vector<FluidLevel> levels;
    std::size_t voxels = 0;
    double noise_hu = 0;    ///< of softTissueNoise()
    double runaway_ml = 0;  ///< flooded from a pool out of the scan, and cut off
};

/// Adds tagged fluid to `labels` (kGas where gas is, 0 elsewhere), which has the grid of `volume`: what lies under gas
/// along a flat face normal to gravity, and everything of at least half-way density connected to it.
/// A wall between gas and something bright is told from a fluid level by its thickness and its shape.
FluidResult addTaggedFluid(const HuVolume& volume, Vector3 gravity, const FluidDensities& densities,
                           InsideVolume& labels, Progress& progress);

/// Adds the tagged fluid that a person points at, level or not: everything of at least half-way density connected to
/// the voxel at `point`. Does nothing where that is no brighter than `fluid_above_hu`, or has a label.
void addFluidAt(const HuVolume& volume, Point3 point, const FluidDensities& densities, InsideVolume& labels);

}  // namespace vicon::steps

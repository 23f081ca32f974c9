#pragma once

#include <vector>

#include "fluid.h"

namespace vicon::steps {

/// A column of voxels from gas down into fluid.
struct Contact {
    Index3 gas;              ///< the last voxel of gas
    int steps = 0;           ///< voxels from there to the first one of at least half-way density
    float density_hu = 0;    ///< of the fluid below
    float level_voxels = 0;  ///< where the density passes half-way between gas and fluid, along gravity
};

/// Contacts that form one flat level.
struct ContactPatch {
    std::vector<Contact> contacts;
    double density_hu = 0;
};

/// The voxel axis nearest to gravity, and its direction along that axis.
struct Down {
    int axis = 1;
    int sign = 1;
};
Down downFor(const Grid& grid, Vector3 gravity);

/// Finds the flat levels between gas and fluid.
std::vector<ContactPatch> findFluidLevels(const HuVolume& volume, Down down, const FluidDensities& densities,
                                          const InsideVolume& labels);

}  // namespace vicon::steps

#pragma once

#include <vector>

#include "segment/fluid/fluid.h"

namespace vicon::steps {

/// A column of voxels from gas down into fluid.
struct Contact {
    Index3 gas;              ///< the last voxel of gas
    int steps = 0;           ///< voxels from there to the first one of at least half-way density
    float density_hu = 0;    ///< of the fluid below
    float below_voxels = 0;  ///< from the gas voxel down its column to half-way between gas and fluid
    float level_voxels = 0;  ///< depth along gravity at which the density passes half-way between gas and fluid
};

/// Contacts that form one flat level.
struct ContactPatch {
    std::vector<Contact> contacts;
    double density_hu = 0;
    bool noisy = false;  ///< half-way to tissue lies so near to the fluid's own density that noise makes holes in it
};

/// Gravity, the voxel axis nearest to it, and its direction along that axis. On an oblique scan the two differ: columns
/// are followed along the axis, but a level is flat across gravity.
struct Down {
    int axis = 1;
    int sign = 1;
    Vector3 gravity;  ///< unit vector
};
Down downFor(const Grid& grid, Vector3 gravity);

/// Finds the flat levels between gas and fluid.
/// @param noise_hu standard deviation of the noise in soft tissue
std::vector<ContactPatch> findFluidLevels(const HuVolume& volume, Down down, const FluidDensities& densities,
                                          double noise_hu, const InsideVolume& labels);

}  // namespace vicon::steps

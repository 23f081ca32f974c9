#pragma once

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The densities of a part of the scan and of 8 voxels beyond it, as far as the scan goes: all that the surface of a
/// lumen in that part and its normals depend on, in a quarter of the memory.
/// @param part a grid on the lattice of `volume`, inside it
/// Throws Error{bad_input} when it is on another lattice, Error{no_memory}.
HuVolume densitiesAround(const HuVolume& volume, const Grid& part);

}  // namespace vicon::steps

#pragma once

#include "course.h"
#include "wall.h"

namespace vicon::phantom {

/// Fluid that has run together where the colon's floor is lowest: pools with their stations, levels and densities, in
/// order of station. Pools do not overlap.
std::vector<FluidPool> drawPools(std::uint64_t seed, const Course& course, const Wall& wall, Position position);

}  // namespace vicon::phantom

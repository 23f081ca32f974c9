#pragma once

#include <cstdint>
#include <vector>

#include "grid/wall_field.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {

/// A wall field's values as whole numbers: half the memory of floats, and the wall's place to 1e-4 of a voxel.
inline constexpr float kWallScale = 10000;

/// The field's value of every voxel, times kWallScale: below 0 inside, above 0 outside, kWallScale away from the wall.
/// One more voxel on every side, so that a contour closes where the scan ends.
Volume<std::int16_t> wallValues(const WallField& field, const InsideVolume& inside);

/// How far from the wall the voxels beside it are: the value there over its slope towards the other side, steepest
/// along each axis. Never farther than where the wall crosses the way to a neighbour. In order of their offsets.
/// @param values of wallValues()
std::vector<NearWall> findNearWall(const Volume<std::int16_t>& values, const InsideVolume& inside);

}  // namespace vicon::steps

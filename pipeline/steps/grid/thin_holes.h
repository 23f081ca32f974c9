#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// A hole in a thin wall or fold, two voxels thick.
struct ThinHole {
    std::vector<std::size_t> voxels;  ///< ascending
    bool only_way = false;            ///< nothing else that is open joins its sides
};

/// Finds the holes of thin walls and folds: where the open lumen on both sides of a hole does not hang together near
/// it. Blur leaves a wall less than half a voxel of tissue there; what is left of it is a ridge of the fraction that
/// every way through the hole must cross. A hole without such a ridge is none that the fraction could tell from a
/// passage.
/// @param fraction of tissue, UINT8_MAX where there is nothing else
/// @return in the order of their voxels
std::vector<ThinHole> findThinHoles(const Volume<std::uint8_t>& fraction, const InsideVolume& lumen);

Point3 middleOf(const ThinHole& hole, const Grid& grid);

}  // namespace vicon::steps

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/run_labels.h"
#include "vicon/core/untrusted_wall.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// A wall that the densities hardly show, and its voxels as they were before it was closed.
struct ClosedWall {
    struct Voxel {
        std::size_t at = 0;
        std::uint8_t label = kOutside;  ///< of the lumen
        std::uint8_t fraction = 0;      ///< of tissue
    };
    FaintWall wall;
    std::vector<Voxel> voxels;
};

/// Makes a voxel wall: no lumen, of so much tissue at least. Returns it as it was.
ClosedWall::Voxel closeVoxel(std::size_t at, float fraction, TissueVolume& tissue, InsideVolume& lumen);

/// Opens those again that cut a piece of the labels in two: the segmentation saw a way there.
/// @param pieces of the labels, over faces
/// @param closed those that are opened go
void reopenCuts(const RunLabels& pieces, std::vector<ClosedWall>& closed, TissueVolume& tissue, InsideVolume& lumen);

}  // namespace vicon::steps

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "grid/run_labels.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Sets of tissue without a wall, and of lumen behind one, up to here are noise or bubbles: 0.03 ml at the usual
/// voxels.
constexpr std::size_t kSpeck_voxels = 100;

/// For each component of the lumen whether it is the largest within its piece.
std::vector<bool> largestOfPieces(const RunLabels& pieces, const RunLabels& lumen);

/// Whether two pieces lie so near to these voxels that the lumen could join them there.
bool areNearTwoPieces(const RunLabels& pieces, const Grid& grid, std::span<const std::size_t> voxels);

/// The labels with the wall where the fraction of tissue is one half: what lies inside and holds more tissue is
/// outside, and what lies beside the lumen and holds less is inside, at most two voxels from what was inside. Specks of
/// tissue that hang on no wall stay lumen. Its pieces, connected over faces, stay what they are: nothing joins two, and
/// a wall that would cut one in two is left out.
/// @param pieces of the labels, over faces
/// @param left_out voxels of the labels that are no lumen
InsideVolume lumenOf(const TissueVolume& tissue, const InsideVolume& inside, const RunLabels& pieces,
                     const std::vector<std::size_t>& left_out);

/// The fraction as whole numbers for a contour at 0: below 0 in `lumen`, above 0 elsewhere, as far from it as the
/// fraction from one half. One more voxel on every side, so that a contour closes where the scan ends.
Volume<std::int16_t> tissueValues(const TissueVolume& tissue, const InsideVolume& lumen);

/// The gradient of the fraction, smoothed across its own direction, per voxel along the grid's axes.
Vector3 tissueGradient(const TissueVolume& tissue, Index3 v);

}  // namespace vicon::steps

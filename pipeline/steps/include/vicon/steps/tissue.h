#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// How much of each voxel is tissue: 0 for none of it, 255 for all.
using TissueVolume = Volume<std::uint8_t>;

struct TissueResult {
    TissueVolume tissue;   ///< 255 farther than about 5 mm from the lumen
    InsideVolume lumen;    ///< the labels, with the wall where half of a voxel is tissue
    HuVolume cleansed;     ///< the densities with tagging taken out: -1000 + 1040 x fraction beside tagging
    nlohmann::json found;  ///< measures, for the step's record
};

/// Finds the fraction of tissue in each voxel of the lumen and about 5 mm around it, as a mixture of tissue with what
/// fills the lumen there.
///
/// Away from fluid levels the densities of an edge tell: between gas and tissue, or tissue and the fluid of that place.
/// At a level the lumen itself passes through tissue's densities. There its density is modelled, a step across gravity
/// blurred by the scanner, whose height, width and fluid are fitted to columns of pure gas over pure fluid; what
/// deviates from it towards tissue is tissue. Sheets of tissue so thin that blur leaves them less than half are scaled
/// by their own height. Along the wall the fraction is smoothed.
///
/// @param hu on the lattice of `inside`, at least as large
/// @param gravity unit vector along which fluid falls
/// @param noise_hu standard deviation of the noise in soft tissue
/// All volumes lie on the grid of `inside`. The result does not depend on the number of threads.
/// Throws Error{bad_input} when the grids do not fit together, Error{no_memory}.
TissueResult findTissue(const HuVolume& hu, const InsideVolume& inside, Vector3 gravity, const WallDensities& densities,
                        double noise_hu, Progress& progress);

}  // namespace vicon::steps

#pragma once

#include <cstddef>

#include "tissue/fraction_noise.h"
#include "tissue/levels.h"
#include "tissue/stool.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Thin sheets of tissue with lumen on both sides: what was kept of them.
struct SheetsFound {
    std::size_t ridge_voxels = 0;  ///< along their middles
    std::size_t faint_voxels = 0;  ///< of those, where blur left less than half: without scaling a hole
};

/// Scales sheets of tissue, folds and septa, so thin that the scanner's blur leaves their middle less than whole: by
/// their own height, so that their surface lies where that of a sheet of such a height does. Never thinner than about a
/// millimetre, never fainter than noise could make them.
/// @param inside with the stool in it; between stool and gas lies no sheet, as there is none between gas and the fluid
/// below it
SheetsFound keepSheets(const InsideVolume& inside, const Stool& stool, const DownAxis& down, const FractionNoise& noise,
                       TissueVolume& tissue);

}  // namespace vicon::steps

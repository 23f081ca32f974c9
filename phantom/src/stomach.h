#pragma once

#include "vicon/core/volume.h"

namespace vicon::phantom {

/// The gas of an upper abdomen, as distances to its wall, negative inside.
struct StomachGas {
    FieldVolume stomach_mm;  ///< with its folds; ends at the gullet and at the pylorus
    FieldVolume other_mm;    ///< gullet and bulb, which the stomach's gas joins through narrow mouths, and colon
};

/// A J of 34 mm radius under the left diaphragm that narrows to the right, with folds up to 6 mm high.
StomachGas drawStomach(const Grid& grid, std::uint64_t seed);

/// The densities around it, in HU, without blur and noise.
double abdomenHu(Point3 p);

}  // namespace vicon::phantom

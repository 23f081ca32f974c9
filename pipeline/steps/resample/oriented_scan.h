#pragma once

#include <array>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// How the axes along which a scan is stored lie to those nearest to +x, +y, +z.
struct OrientedScan {
    HuVolume& acquired;
    std::array<unsigned, 3> order{0, 1, 2};  ///< axis d is the stored axis order[d] ...
    std::array<bool, 3> flipped{};           ///< ... against its direction where flipped[d]
    Grid grid;                               ///< of the scan along these axes; the origin is rounded to 1e-6 mm

    bool asStored() const;
};

/// @param acquired must outlive the result
OrientedScan orient(HuVolume& acquired);

}  // namespace vicon::steps

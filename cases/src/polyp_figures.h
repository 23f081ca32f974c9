#pragma once

#include <array>
#include <optional>

#include "traced_polyp.h"
#include "vicon/cases/marker_measures.h"
#include "vicon/core/scanner_blur.h"

namespace vicon {

/// Diameter, height and volume, corrected for blur and noise, with their intervals.
/// @param chord the largest
/// @param middle of the rim
PolypSize figuresOf(const TracedPolyp& polyp, const HeadChord& chord, Point3 middle, const BlurAndNoise& scan);

/// The largest diameter in a plane across one of the axes, corrected likewise; never above that in space. Nothing where
/// no plane cuts the head.
std::optional<PlaneSize> bestPlaneOf(const TracedPolyp& polyp, const PolypSize& size,
                                     const std::array<Vector3, 3>& axes, const BlurAndNoise& scan);

}  // namespace vicon

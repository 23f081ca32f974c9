#pragma once

#include <optional>

#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// By how much walls of gas look denser than tissue in their first millimetre, in HU: what an edge-enhancing kernel
/// makes of them. The median over the edges between gas and tissue along a sample of the rows; nothing where there are
/// too few of them.
std::optional<double> edgeOvershoot_hu(const HuVolume& hu, const WallDensities& densities);

/// The densities of a sharp kernel as a usual one would have made them.
struct SoftenedDensities {
    HuVolume hu;
    double overshoot_hu;  ///< of the sharp one's edges
};

/// Blurs the densities within their slices; nothing where edges do not overshoot. Where they do, walls are as bright as
/// tagging, and so is noise. What was not measured stays kPaddingHu. Throws Error{no_memory}.
std::optional<SoftenedDensities> softened(const HuVolume& hu, const WallDensities& densities);

}  // namespace vicon::steps

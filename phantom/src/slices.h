#pragma once

#include <utility>

#include "vicon/phantom/phantom.h"

namespace vicon::phantom {

/// The options of a scan of slices of at most 1 mm, and how many of them make one of the thickness that is asked for.
std::pair<PhantomOptions, int> withThinSlices(const PhantomOptions& options);

/// Means of so many slices, side by side, on a grid of their own; padding where one of them is.
HuVolume averagedSlices(HuVolume thin, int of_each);

/// Adds densities on the same grid, within what a scan can hold; padding stays.
void addTo(HuVolume& hu, const HuVolume& more_hu);

}  // namespace vicon::phantom

#pragma once

#include <cstdint>

#include "resample/oriented_scan.h"
#include "resample/sampling.h"
#include "vicon/steps/resample.h"

namespace vicon::steps {

/// Makes the slices `of_new` of the resampled volume, by linear interpolation, at `out`.
/// Throws Error{no_memory} where there is no memory for the slab.
void resampleLinearly(const OrientedScan& scan, const Sampling& sampling, SliceRange of_new, std::int16_t* out);

/// Puts the smooth interpolation in place of the linear one, except near padding. Uses all of ITK's threads.
void smoothOver(const OrientedScan& scan, const Sampling& sampling, SliceRange of_new, Interpolation interpolation,
                std::int16_t* out);

}  // namespace vicon::steps

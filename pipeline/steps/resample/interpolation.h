#pragma once

#include "grid/itk_view.h"
#include "resample/sampling.h"
#include "vicon/steps/resample.h"

namespace vicon::steps {

/// Acquired slices, along the oriented axes, and which they are.
struct AcquiredSlab {
    ItkHu::Pointer slices;
    SliceRange range;
};

// Of the smooth ones; the linear one is LinearResampleFilter.

/// How many acquired voxels away a density still has a weight worth counting.
int reachOf(Interpolation interpolation);

/// New slices by the cubic B-spline through the densities, or by a sinc with a Lanczos window three voxels wide to each
/// side. Padding is taken as a density: what lies within reachOf() of it must not be used.
ItkFloat::Pointer interpolateSmoothly(const AcquiredSlab& acquired, const Sampling& sampling, SliceRange of_new,
                                      Interpolation interpolation);

}  // namespace vicon::steps

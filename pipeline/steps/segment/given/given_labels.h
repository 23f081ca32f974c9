#pragma once

#include "segment/body.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// Above this density, half-way from tissue to the least of tagged fluid, something is taken for tagged fluid.
double fluidFrom_hu(const SegmentOptions& options);

struct GivenLabels {
    InsideVolume labels;  ///< kGas and kFluid, on the scan's grid
    double dense_ml = 0;  ///< of the given lumen that is as dense as tissue, and was left out
};

/// Tells gas from fluid in a given lumen by the scan's densities. What is neither takes the label of what it touches,
/// as far as the scanner's blur reaches; so do the layers between gas and fluid.
GivenLabels labelGiven(const HuVolume& volume, const InsideVolume& given, const SegmentOptions& options,
                       Progress& progress);

/// Adds the gas or tagged fluid that a person points at to the labels.
void addGasAndFluidAt(const HuVolume& volume, const Body& body, Point3 point, const SegmentOptions& options,
                      InsideVolume& labels);

}  // namespace vicon::steps

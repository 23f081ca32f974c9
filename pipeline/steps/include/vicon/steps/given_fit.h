#pragma once

#include <string>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {

/// How a given lumen lies in a scan.
struct GivenFit {
    double in_scan = 0;       ///< share of its voxels whose centre lies in the scan
    double of_scan = 0;       ///< what lies in the scan, as a share of the scan's volume
    double gas = 0;           ///< share of what lies in the scan that is gas in the body
    double fluid = 0;         ///< ... that is as dense as tagged fluid; bone is too
    std::string mirrored;     ///< how it would have to be mirrored to fit better; empty where it would not
    double mirrored_fit = 0;  ///< the share of gas and fluid then

    double gasOrFluid() const { return gas + fluid; }
};

/// Holds a lumen against the scan's densities: a colon's is gas and tagged fluid wherever it lies. Mirrored is tried
/// about a middle, as where a program wrote its axes the other way round, and about the origin of patient coordinates,
/// as where RAS was taken for LPS.
/// @param volume isotropic densities, as segmentColon() takes them
/// @param mask 0 or 1, on any lattice
/// @param middle_mm of the lattice on which the other program wrote it
GivenFit fitOf(const HuVolume& volume, const InsideVolume& mask, Point3 middle_mm, const SegmentOptions& options,
               Progress& progress);

}  // namespace vicon::steps

#pragma once

#include <string>

#include "vicon/phantom/phantom.h"

namespace vicon::test {

/// How far the results of two acquisitions of one patient lie apart.
struct Difference {
    double dice = 0;             ///< of the two lumens
    double truth_dice = 0;       ///< of the two true lumens: what the voxels allow
    double straight_dice = 0;    ///< of the lumen found in axial slices and its truth
    double oblique_dice = 0;     ///< the same of the turned slices
    double curve_mean_mm = 0;    ///< from points of each curve to the other
    double curve_most_mm = 0;    ///< 95th percentile
    double length_fraction = 0;  ///< signed
};

/// Acquires the phantom with axial slices and with slices turned by `degrees` about the left-right axis, runs resample,
/// segment and skeleton on both, and compares. The options' field must hold the colon in both.
Difference obliqueDifference(const phantom::PhantomOptions& options, const std::string& position, double degrees);

}  // namespace vicon::test

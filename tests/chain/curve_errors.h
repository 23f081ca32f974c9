#pragma once

#include "vicon/core/skeleton.h"
#include "vicon/phantom/phantom.h"

namespace vicon::test {

/// How far a centreline lies from the true one.
struct CurveErrors {
    double mean_mm = 1e9, p95_mm = 1e9;  ///< of its points
    double length_fraction = 0;          ///< of its length more than the true one
    bool directed = false;               ///< from the rectum to the caecum, never back by more than its own error
};

CurveErrors curveErrors(const Skeleton& found, const phantom::PhantomTruth& truth);

/// Whether each true gap lies between the same two found pieces, and nothing else does.
bool piecesInOrder(const Skeleton& found, const phantom::PhantomTruth& truth);

}  // namespace vicon::test

#pragma once

#include "skeleton_smooth.h"

namespace vicon::steps {

/// How far the lumen reaches from a point along a unit vector: steps of the wall distance never pass the wall.
double reach(const DistanceProbe& wall, Point3 from, Vector3 along, double limit_mm);

/// Every point moved to the middle of the lumen's cross-section there, which is fitted to the wall over a stretch of
/// the curve: what is short along the curve (folds, polyps, a contact's opening) does not pull the middle away.
/// @param line evenly spaced, inside the lumen
/// @param rays per cross-section
Polyline recentred(const Polyline& line, const DistanceProbe& wall, double step_mm, int rays);

}  // namespace vicon::steps

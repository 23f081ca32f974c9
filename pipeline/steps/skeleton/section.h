#pragma once

#include "skeleton/smooth.h"

namespace vicon::steps {

/// How far the lumen reaches from a point along a unit vector: steps of the wall distance never pass the wall.
double reach(const DistanceProbe& wall, Point3 from, Vector3 along, double limit_mm);

/// What counts as the middle of a stretch of lumen: the fitted one where it is a tube, else the median's; or the
/// median's alone, which is cheaper and near enough for all but the last recentrings.
enum class Middle { fitted, median };

/// Every point moved to the middle of the lumen's cross-section there, which is fitted to the wall over a stretch of
/// the curve: what is short along the curve (folds, polyps, a contact's opening) does not pull the middle away.
/// @param line evenly spaced, inside the lumen
/// @param rays per cross-section
Polyline recentred(const Polyline& line, const DistanceProbe& wall, double step_mm, int rays, Middle middle);

}  // namespace vicon::steps

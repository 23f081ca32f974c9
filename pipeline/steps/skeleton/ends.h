#pragma once

#include "skeleton/smooth.h"

namespace vicon::steps {

/// Cuts both ends of a path off about one local radius before its tips.
Polyline withoutTips(const Polyline& path, const DistanceProbe& wall);

/// Lengthens or shortens a curve so that both its ends lie one local radius inside the lumen's tips: the path from
/// which it was made may run beside the middle there, and so take the local radius for smaller.
Polyline endsOneRadiusIn(Polyline line, const DistanceProbe& wall, double step_mm);

}  // namespace vicon::steps

#pragma once

#include <optional>
#include <vector>

#include "vicon/core/scan_records.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/lumen.h"

namespace vicon::viewer {

/// Half-way between gas and soft tissue, as the steps had it that made the scan's surface (segment.wall_hu): there the
/// wall as acquired stands. The default where they do not say.
double gasEndsOf_hu(const std::vector<StepRecord>& steps);
/// How far behind the lumen's wall the wall as acquired is looked for.
inline constexpr double kBehindWall_mm = 5;

/// Whether the acquired density there is that of gas: from elsewhere nothing is seen as acquired.
bool startsInGas(const HuView& volume, double gas_ends_hu, Point3 eye_mm);

/// Distance along a ray to the wall as acquired: to where trilinear densities leave gas, be it at tissue, tagged fluid
/// or stool. Nothing where the ray does not start in gas, and where gas does not end within `reach_mm` and
/// kBehindWall_mm of the lumen's wall.
std::optional<double> distanceToAcquiredWall_mm(const HuView& volume, double gas_ends_hu, const Lumen& lumen,
                                                Point3 from, Vector3 direction, double reach_mm);

/// How much of a picture shows fluid or stool that stands before the wall, 0 to 1; 0 where the eye is not in gas.
double standingShare(const HuView& volume, double gas_ends_hu, const Lumen& lumen, const Pose& pose, const Lens& lens);

}  // namespace vicon::viewer

#pragma once

#include "vicon/viewer/model/look_ahead.h"
#include "vicon/viewer/model/lumen.h"
#include "vicon/viewer/model/path_frames.h"

namespace vicon::viewer {

/// An eye keeps this from the wall wherever the lumen is wide enough; on a way that tapers off half of the way's
/// radius, where that is less. Chosen on bent tubes with folds (radius 8 to 25 mm) and on a real prone scan.
inline constexpr double kCameraRadius_mm = 2;
/// From eye to the point that is looked at, where there is room. Chosen on the same.
inline constexpr double kLeastDistance_mm = 15, kMostDistance_mm = 45;

/// An eye in the lumen and what is known of it.
struct ViewPose {
    Pose pose;
    double station_mm = 0;    ///< of the place on the path from which it looks
    double clearance_mm = 0;  ///< distance of the eye from the wall
    bool sees_target = true;  ///< false: no place was found from which the point is in plain view
};

/// Looking from a station to where the lumen opens ahead, as LookAhead says. On a bridge or where the lumen is narrower
/// than the camera, from the nearest station that is not. Throws Error{unusable_scan} when no station of the path lies
/// in the lumen.
ViewPose poseAtStation(const PathFrames& path, const Lumen& lumen, double station_mm,
                       Heading heading = Heading::caecum);
/// The same for many stations of one path.
/// @param ahead of the same path and lumen
ViewPose poseAtStation(const PathFrames& path, const Lumen& lumen, const LookAhead& ahead, double station_mm,
                       Heading heading);

/// Looking at a point on or near the wall, from the path before it (towards the rectum) where that sees it, else from
/// behind it, else from beside the path, else from straight above the wall. The point projects to the middle.
/// Throws Error{unusable_scan} when no station of the path lies in the lumen.
ViewPose poseForPoint(const Skeleton& skeleton, const PathFrames& path, const Lumen& lumen, Point3 point_mm);

}  // namespace vicon::viewer

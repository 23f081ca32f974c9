#pragma once

#include <vector>

#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/view_pose.h"

namespace vicon::viewer {

/// How well the frames of a flight can be read.
struct FlightQuality {
    double way_on_central = 0;  ///< share of frames in which the way on lies in the middle half, 0 to 1
    double wall_close = 0;      ///< share of frames in which the middle shows wall nearer than the lumen's radius
    double turn_median_deg_mm = 0, turn_slow_deg_mm = 0;  ///< of the view a millimetre of path; slow: 99 % turn less
    double roll_median_deg_mm = 0;                        ///< of the picture about its middle
};

/// Judges a flight by what can be seen from each of its places: the way on is the farthest place of the path ahead that
/// is in plain view from the eye without a gap before it. What is jumped over between two frames, 15 mm and more, does
/// not count as a turn; turns are 0 where that is most of the flight.
/// @param poses in the order of flight
FlightQuality qualityOf(const std::vector<ViewPose>& poses, Heading heading, const PathFrames& path, const Lumen& lumen,
                        const Lens& lens);

}  // namespace vicon::viewer

#pragma once

#include <array>
#include <vector>

#include "vicon/viewer/model/lumen.h"
#include "vicon/viewer/model/path_frames.h"

namespace vicon::viewer {

/// Which way along the path.
enum class Heading { caecum, rectum };

/// Where a camera that follows the path looks: to where the lumen opens. That is about the farthest place of the path
/// ahead that is in plain view without a gap before it; where a fold stands before a part of the lumen there, rather
/// into the open than at the fold's rim. Remembers what it found out about the path; not for several threads
/// at once.
class LookAhead {
public:
    /// The path, and the voxels of the lumen, must outlive it.
    LookAhead(const PathFrames& path, const Lumen& lumen);

    /// A unit vector. Continuous along the path.
    /// @param eye_mm at or beside the path at this station
    Vector3 direction(double station_mm, Point3 eye_mm, Heading heading) const;
    /// How much the view turns there for a millimetre of path, radians.
    double turn_rad_mm(double station_mm, Heading heading) const;
    /// How far ahead along the path the place lies that is in plain view from the path, mm; 0 where the lumen is too
    /// narrow to look through.
    double sight_mm(double station_mm, Heading heading) const;

private:
    struct Node {
        Vector3 way;  ///< a unit vector; none: not known yet
        double sight_mm = 0;
    };
    const Node& nodeAt(int node, Heading heading) const;
    Node lookFrom(double station_mm, double sign) const;
    double farthest_mm(const PathFrame& here) const;  ///< that is looked at
    double sightFrom(const PathFrame& here, double station_mm, double sign) const;
    Vector3 openFrom(const PathFrame& here, Vector3 way) const;

    const PathFrames* path_;
    Lumen lumen_;
    mutable std::array<std::vector<Node>, 2> nodes_;  // along the path, by heading
};

}  // namespace vicon::viewer

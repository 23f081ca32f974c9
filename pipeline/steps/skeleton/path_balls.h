#pragma once

#include "skeleton/smooth.h"

namespace vicon::steps {

/// The largest balls inside the lumen about a path through it. Where the lumen is flat, or a tube narrower than what a
/// line is smoothed over, the middle of a section may lie where there is hardly any room, several radii from the path;
/// within the balls the line has the room that the path found.
class PathBalls {
public:
    PathBalls(const Polyline& path, const DistanceProbe& wall);

    /// The line, each of its points that lies outside all balls moved to the nearest of them.
    Polyline hold(Polyline line) const;

private:
    struct Ball {
        Point3 centre;
        double radius_mm = 0;
    };
    /// The number of a ball that holds a point, sought outwards from a number; the count of all where none does.
    std::size_t holderOf(Point3 p, std::size_t about) const;
    /// The point, moved to the nearest ball.
    Point3 held(Point3 p) const;

    std::vector<Ball> balls_;
};

}  // namespace vicon::steps

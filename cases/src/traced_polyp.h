#pragma once

#include <optional>
#include <vector>

#include "polyp_profile.h"
#include "vicon/core/geometry.h"

namespace vicon {

/// A polyp as its sections show it, each from its axis outwards.
struct TracedPolyp {
    Point3 top;
    Vector3 axis;  ///< unit vector into the lumen
    std::vector<PolypProfile> profiles;
    std::vector<std::optional<std::size_t>> rims;  ///< of each profile, the number of the point where the head ends

    std::vector<Point3> rimPoints() const;
};

/// Between two points of the head.
struct HeadChord {
    double length_mm = 0;
    Point3 from, to;
    int ends_at_rim = 0;

    /// With both ends: then the head stands on the wall, else on a stalk.
    bool onWall() const { return ends_at_rim == 2; }
};

/// Points of a head's surface, as in a plane.
struct HeadCut {
    std::vector<Point3> points;
    std::vector<bool> at_rim;

    HeadChord largest() const;
    /// Of the polygon of the points around their middle, in the plane of two unit vectors.
    double area_mm2(Point3 middle, Vector3 along, Vector3 up) const;
};

/// The largest chord in space.
HeadChord largestChordOf(const TracedPolyp& polyp);

/// The cut with the plane that lies so far from the top along a unit normal; no points where it misses the head.
HeadCut cutOf(const TracedPolyp& polyp, Vector3 normal, double at_mm);

/// Of the head above the cone from the rim to its middle, by wedges (Pappus).
double seenVolume_mm3(const TracedPolyp& polyp, Point3 middle);

/// How the wall rises behind the head, as an angle: on a flat one 0, in a narrow colon more. Of the middle half of the
/// sections: folds beside it do not count.
double wallRise_rad(const TracedPolyp& polyp);

/// How steeply the rim runs at its ends, as the mean square of rise over way along it: in a saddle, as inside of a
/// bend, it climbs on one side and falls on the other; on a plane 0, and no more than 1.
double rimSlope2(const TracedPolyp& polyp, const HeadChord& chord);

/// How far the rim's points lie from the cubic through the four beside them, root mean square: an even bend is none.
double roughness_mm(const std::vector<Point3>& rim);

}  // namespace vicon

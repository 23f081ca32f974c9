#pragma once

#include <algorithm>

#include "vicon/core/geometry.h"

namespace vicon {

/// Where on the straight way from `a` to `b` the point nearest to `p` lies: 0 at a, 1 at b; 0 where the two are one.
inline double nearestOnSegment(Point3 a, Point3 b, Point3 p)
{
    const Vector3 ab = b - a;
    const double ab2 = dot(ab, ab);
    return ab2 > 0 ? std::clamp(dot(p - a, ab) / ab2, 0.0, 1.0) : 0;
}

}  // namespace vicon

#include "wall_rays.h"

#include <algorithm>

namespace vicon::viewer {

std::optional<double> WallRays::along(Vector3 direction, double from_mm, double reach_mm) const
{
    double before = from_mm;
    for (double at = from_mm; at <= reach_mm;) {
        const Point3 p = eye_mm_ + direction * at;
        const double free = lumen_.freeBall_mm(p);
        if (free > near_mm_) {
            before = at;
            at += std::max(free - near_mm_, near_mm_ / 2);
            continue;
        }
        if (lumen_.clearance_mm(p) > near_mm_) {
            before = at;
            at += near_mm_ / 2;
            continue;
        }
        for (int halving = 0; halving < 6; ++halving) {
            const double middle = (before + at) / 2;
            (lumen_.clearance_mm(eye_mm_ + direction * middle) > near_mm_ ? before : at) = middle;
        }
        return at;
    }
    return {};
}

double WallRays::freeBeam_mm(Vector3 direction, double spread, double reach_mm) const
{
    double at = 0;
    while (at < reach_mm) {
        // The ball around the middle must hold the whole beam there.
        const double free = lumen_.freeBall_mm(eye_mm_ + direction * at);
        const double leap = (free - near_mm_ - spread * at) / (1 + spread);
        if (leap < near_mm_)
            break;
        at += leap;
    }
    return std::min(at, reach_mm);
}

}  // namespace vicon::viewer

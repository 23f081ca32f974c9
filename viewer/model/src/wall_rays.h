#pragma once

#include <optional>

#include "vicon/viewer/model/lumen.h"

namespace vicon::viewer {

/// Where rays from one eye meet the wall: where the trilinear distance to it falls below half a voxel. Leaps by the
/// distance of the nearest voxel.
class WallRays {
public:
    WallRays(const Lumen& lumen, Point3 eye_mm) : lumen_(lumen), eye_mm_(eye_mm), near_mm_(lumen.voxel_mm() / 2) {}

    /// @param from_mm a part of the ray that is known to be free
    /// @return distance from the eye, or nothing where there is no wall within `reach_mm`
    std::optional<double> along(Vector3 direction, double from_mm, double reach_mm) const;
    /// How far from the eye no ray meets the wall whose unit direction differs from `direction` by at most `spread`.
    double freeBeam_mm(Vector3 direction, double spread, double reach_mm) const;

private:
    Lumen lumen_;
    Point3 eye_mm_;
    double near_mm_;
};

}  // namespace vicon::viewer

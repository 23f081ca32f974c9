#pragma once

#include <optional>

#include "vicon/cases/marker_measures.h"
#include "vicon/core/cell_surface.h"
#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"

namespace vicon {

/// Where a finding was circled on the wall.
struct CircledWall {
    Point3 surface_mm;     ///< in the middle of the circle
    Vector3 inwards;       ///< unit vector into the tissue
    double raised_mm = 0;  ///< of the surface over the wall around the circle; 0: nothing stands there
};

/// The wall that a ball around a point on it, or of a finding on it, encloses, as it is circled straight from the
/// lumen. Throws Error{bad_input} where no wall lies within the ball.
/// @param surface the wall, with normals into the lumen
CircledWall circleWall(const CellSurface& surface, Point3 at, double radius_mm);

/// Takes the voxels whose middles lie within `radius_mm` of `centre`, in tissue alone. A voxel beside the lumen has a
/// density between that of the tissue and that of the gas or tagged fluid, so a margin of 2 mm and at least 1.5 voxels
/// is kept to the lumen's border; where a small finding has fewer than DensitySample::kLeastVoxels then, one of 1.5
/// voxels; where it still has, no voxels are given. Padding is left out. `inside` may cover a part of the volume only:
/// there is no lumen beyond it. Throws Error{wrong_use} for a radius outside 0.5 to 25 mm, Error{cancelled} where
/// `wanted` is no longer.
///
/// Below the wall around a circled finding only what belongs to the tissue at its surface is taken: what is not lighter
/// than -30 HU, and ends 1.5 voxels before the first that is, counted straight away from the surface. What stands above
/// the wall is the finding, of whatever density: a lipoma is as light as the fat behind a wall that is bare.
DensitySample sampleDensity(const HuView& volume, const InsideView& inside, Point3 centre, double radius_mm,
                            const std::optional<CircledWall>& wall = {}, const Progress* wanted = nullptr);

}  // namespace vicon

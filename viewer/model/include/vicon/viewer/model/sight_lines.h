#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/patches.h"

namespace vicon::viewer {

/// A surface as it is drawn.
struct DrawnSurface {
    const std::vector<float>& points_mm;          ///< x, y, z of each point, LPS
    const std::vector<std::uint32_t>& triangles;  ///< three point numbers each
    const std::vector<Patch>& patches;
};

/// Which patches have anything in sight: the thesis' test for empty spots (Algorithm 3.2), asked of the lumen's voxels
/// instead of the colour buffer. What a buffer holds when a cell's turn comes may lie behind what is still to come, so
/// a full buffer proves nothing in a winding lumen; here the picture is cut into squares, a bundle of sight lines
/// leaves the eye through each, and a square is filled where a whole cross-section of its bundle lies outside the
/// lumen: each of its lines has then crossed the wall. Patches of which a bundle meets a triangle before that may be
/// seen.
///
/// Never leaves out a patch of which a pixel shows something, provided that the surface was contoured on the grid of
/// `inside` (it enters only cubes between voxel centres that are partly inside) and that its back is not drawn.
class SightLines {
public:
    /// Takes about 0.4 s and one byte a voxel. The surface and the volume need not live on. Throws
    /// Error{cancelled} where `wanted` is no longer.
    SightLines(const InsideView& inside, const DrawnSurface& surface, const Progress* wanted = nullptr);
    ~SightLines();
    SightLines(SightLines&&) noexcept;
    SightLines& operator=(SightLines&&) noexcept;

    /// Whether the eye lies so deep in the lumen that the near plane cuts no wall open. Elsewhere visibleFrom() proves
    /// nothing.
    bool holdsAt(Point3 eye_mm, double near_mm) const;
    /// For every patch whether it may be seen: 1 or 0. Uses all cores.
    std::vector<std::uint8_t> visibleFrom(const Pose& pose, const Lens& lens) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace vicon::viewer

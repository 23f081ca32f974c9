#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/density_bricks.h"
#include "vicon/viewer/model/lumen.h"
#include "vicon/viewer/model/transfer_function.h"

namespace vicon::viewer {

/// A round part of a picture: the lens under the mouse, an area drawn around a finding.
struct PictureCircle {
    Pixel centre;
    double radius_px = 0;
    bool holds(Pixel p) const { return std::hypot(p.x - centre.x, p.y - centre.y) <= radius_px; }
};

/// How the look below the mucosa is made.
struct PeelingOptions {
    /// Where rays begin: at the wall, tagged fluid looked through; or at the eye, so that fluid is seen as well.
    enum class Begin { wall, eye };
    Begin begin = Begin::wall;
    /// Along the ray, from where it would begin: what lies before is peeled off. Below 0 it begins earlier, at the
    /// eye at most.
    double offset_mm = 0;
    double step_mm = 0.5;        ///< between samples, 0.1 to 2. Half a voxel and more of clinical CT (0.6 to 0.9 mm)
    double reach_mm = 60;        ///< how far below the wall a ray goes at most, or below an offset behind it
    double lamp_reach_mm = 45;   ///< the distance at which the lamp at the eye has lost half of its strength
    bool shaded = true;          ///< by the gradient of the density; else the colours of the transfer function, faded
    double shaded_from = 0.004;  ///< share of the light: samples that stop less are not shaded
    double least_light = 0.002;  ///< share of the light, half a grey level: when less is left a ray ends

    /// For pictures while the eye moves, in 40 % of the time: longer steps, haze is not shaded, dim rays end.
    PeelingOptions whileMoving() const
    {
        PeelingOptions quick = *this;
        quick.step_mm = std::max(step_mm, 1.2);
        quick.shaded_from = 0.04;
        quick.least_light = 0.02;
        return quick;
    }
};

/// A picture with transparency, to lay over the picture of the surface or to show alone on black: red, green, blue
/// (already multiplied by the opacity) and opacity, row by row from the top.
struct PeeledPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Distance along a ray from `from`, in the lumen, to the wall: where the distance to the wall falls below half a
/// voxel. Leaps by the wall distance. Empty when there is none within `reach_mm`; 0 when `from` is that near already.
std::optional<double> distanceToWall_mm(const Lumen& lumen, Point3 from, Vector3 direction, double reach_mm);

/// Casts rays into the densities beyond the wall, front to back, on all cores. Samples lie at multiples of the step
/// from the eye, so where nothing before the wall has opacity the picture equals that of rays cast from the eye.
/// Densities are trilinear; outside the scan and at padding nothing is seen. Source: peeling as in the thesis, chapter
/// 4; empty space leaping by distance: Zuiderveld et al., VBC 1992; bricks of densities that the colours do not show
/// are leapt over too. `only`: the other pixels stay clear. Throws Error{wrong_use} for a step or a picture size out of
/// range, Error{cancelled} where `wanted`, if there is one, says so.
PeeledPicture peel(const DensityBricks& volume, const Lumen& lumen, const Pose& pose, const Lens& lens,
                   const TransferFunction& colours, const PeelingOptions& options = {},
                   const std::optional<PictureCircle>& only = {}, const Progress* wanted = nullptr);
/// For one picture of a volume.
inline PeeledPicture peel(const HuView& volume, const Lumen& lumen, const Pose& pose, const Lens& lens,
                          const TransferFunction& colours, const PeelingOptions& options = {},
                          const std::optional<PictureCircle>& only = {})
{
    return peel(DensityBricks(volume), lumen, pose, lens, colours, options, only);
}

/// Lays a peeled picture over an opaque one of the same size, three bytes a pixel, with `weight` 0 to 1.
void blendOver(std::vector<std::uint8_t>& rgb, const PeeledPicture& peeled, double weight = 1);

}  // namespace vicon::viewer

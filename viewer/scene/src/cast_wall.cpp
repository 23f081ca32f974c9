#include "cast_wall.h"

#include <algorithm>

#include "vicon/viewer/model/acquired_wall.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace vicon::viewer {
namespace {

// Opacity rises over the width that the scanner's blur gives an edge: where it rose at once, the steps of the rays
// would be seen as rings.
constexpr double kFirstSeenBelow_hu = 170, kOpaqueAbove_hu = 100;  // from where gas ends
constexpr double kStepOfOpaque = 0.5;  // of the usual one: a wall that stops a ray at once shows how far apart they are

/// Nothing of gas, all of what is denser.
TransferFunction solid(WallColors colors, double gas_ends_hu)
{
    const auto& [red, green, blue] = wallColor(colors);
    return {"as-acquired",
            "As acquired",
            {{gas_ends_hu - kFirstSeenBelow_hu, red, green, blue, 0},
             {gas_ends_hu, red, green, blue, 0.9},
             {gas_ends_hu + kOpaqueAbove_hu, red, green, blue, 1}}};
}

/// Each pixel as a square of pixels.
PeeledPicture enlarged(const PeeledPicture& from, int times, int width, int height)
{
    PeeledPicture to{width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 4)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::copy_n(from.rgba.begin() + (std::ptrdiff_t(y / times) * from.width + x / times) * 4, 4,
                        to.rgba.begin() + (std::ptrdiff_t(y) * width + x) * 4);
    return to;
}

/// Casts with `colours`; what is cast lies over `picture` with `weight`.
void castOver(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place,
              const TransferFunction& colours, PeelingOptions options, double weight, const Progress* wanted)
{
    options.lamp_reach_mm = lampReachAt_mm(scan.frames(), place.station_mm);
    const Lens lens{request.view_angle_deg, request.width, request.height};
    std::optional<PictureCircle> only;
    if (request.peel.middle_only)
        only = peeledCircle(request);
    for (int y = 0; y < picture.height; ++y)  // what is peeled off is not seen through the rest
        for (int x = 0; x < picture.width; ++x)
            if (!request.peel.over_surface && (!only || only->holds({x + 0.5, y + 0.5})))
                picture.set(x, y, {0, 0, 0});
    const int coarse = std::max(1, request.peel.coarse);
    const Lens few{lens.view_angle_deg, (lens.width + coarse - 1) / coarse, (lens.height + coarse - 1) / coarse};
    if (only)
        only = PictureCircle{{only->centre.x / coarse, only->centre.y / coarse}, only->radius_px / coarse};
    const PeeledPicture cast = peel(scan.bricks(), scan.lumen(), place.pose, few, colours, options, only, wanted);
    blendOver(picture.rgb, coarse == 1 ? cast : enlarged(cast, coarse, lens.width, lens.height), weight);
}

}  // namespace

PictureCircle peeledCircle(const SnapshotRequest& request)
{
    const Pixel middle{request.width / 2.0, request.height / 2.0};
    const double usual_px = 0.3 * std::min(request.width, request.height);
    return {request.peel.circle_at.value_or(middle), request.peel.circle_px > 0 ? request.peel.circle_px : usual_px};
}

void layPeelingOver(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request,
                    const SnapshotResult& place, const Progress* wanted)
{
    PeelingOptions options = request.peel.options;
    if (request.wall.acquired)
        options.begin = PeelingOptions::Begin::eye;
    constexpr double kOverSurface = 0.6;
    castOver(picture, scan, request, place, transferFunction(request.peel.preset), options,
             request.peel.over_surface ? kOverSurface : 1, wanted);
}

void castWall(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place,
              const Progress* wanted)
{
    SnapshotRequest all = request;
    all.peel.middle_only = all.peel.over_surface = false;
    PeelingOptions options = request.peel.options;
    options.offset_mm = 0;
    if (!request.wall.acquired) {
        castOver(picture, scan, all, place, transferFunction("soft-tissue"), options, 1, wanted);
        return;
    }
    if (!startsInGas(scan.volume(), scan.gasEnds_hu(), place.pose.eye_mm))
        return;
    options.begin = PeelingOptions::Begin::eye;
    options.reach_mm = kBehindWall_mm;
    options.step_mm *= kStepOfOpaque;
    castOver(picture, scan, all, place, solid(request.wall.colors, scan.gasEnds_hu()), options, 1, wanted);
}

}  // namespace vicon::viewer

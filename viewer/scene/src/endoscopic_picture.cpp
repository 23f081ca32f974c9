#include <algorithm>
#include <cstdio>

#include "pictures.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {
namespace {

constexpr int kSmooth = 2;
constexpr double kRing_mm = 8;           // a ring that leaves a polyp of 10 mm free
constexpr double kMarkerReach_mm = 150;  // further off a marker is too small to mean anything
constexpr double kSightSlack_mm = 2.5;

// The marker that is looked at is drawn wherever it lies in the picture; others only when in plain view.
void addMarkers(Overlay& overlay, const PreparedScan& scan, const SnapshotRequest& request, const Pose& pose,
                const Lens& lens, double text_px)
{
    const Lumen lumen = scan.lumen();
    for (const Marker& marker : request.markers) {
        const Projected p = project(pose, lens, marker.position_mm);
        const bool in_picture =
            p.depth_mm > 0 && p.at.x >= 0 && p.at.y >= 0 && p.at.x < lens.width && p.at.y < lens.height;
        if (!in_picture || p.depth_mm > kMarkerReach_mm)
            continue;
        const bool target = request.look_at_mm && *request.look_at_mm == marker.position_mm;
        const double allowance = 1.5 * lumen.nearestInside(marker.position_mm, kRing_mm).distance_mm + kSightSlack_mm;
        if (!target && !lumen.sees(pose.eye_mm, marker.position_mm, allowance))
            continue;
        const double most = std::min(lens.width, lens.height) * 0.3;
        const double radius = std::clamp(kRing_mm * lens.focal_px() / p.depth_mm, 1.2 * text_px, most);
        addMarkerRing(overlay, p.at, radius, marker, text_px);
    }
}

/// The circle that is peeled, for a radiologist's eye on one finding.
PictureCircle circleOf(const SnapshotRequest& request)
{
    const Pixel middle{request.width / 2.0, request.height / 2.0};
    const double usual_px = 0.3 * std::min(request.width, request.height);
    return {request.peel_circle_at.value_or(middle), request.peel_circle_px > 0 ? request.peel_circle_px : usual_px};
}

std::string peelingText(const SnapshotRequest& request)
{
    char offset[32];
    std::snprintf(offset, sizeof offset, "%.1f", request.peeling.offset_mm);
    return "peeled: " + transferFunction(request.peel).title + ", " + offset + " mm below the surface";
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

void layPeelingOver(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request, const Pose& pose)
{
    const Lens lens{request.view_angle_deg, request.width, request.height};
    std::optional<PictureCircle> only;
    if (request.peel_middle_only)
        only = circleOf(request);
    for (int y = 0; y < picture.height; ++y)  // what is peeled off is not seen through the rest
        for (int x = 0; x < picture.width; ++x)
            if (!only || only->holds({x + 0.5, y + 0.5}))
                picture.set(x, y, {0, 0, 0});
    const int coarse = std::max(1, request.peel_coarse);
    const Lens few{lens.view_angle_deg, (lens.width + coarse - 1) / coarse, (lens.height + coarse - 1) / coarse};
    if (only)
        only = PictureCircle{{only->centre.x / coarse, only->centre.y / coarse}, only->radius_px / coarse};
    const PeeledPicture peeled =
        peel(scan.bricks(), scan.lumen(), pose, few, transferFunction(request.peel), request.peeling, only);
    blendOver(picture.rgb, coarse == 1 ? peeled : enlarged(peeled, coarse, lens.width, lens.height));
}

std::string directionText(const Pose& pose)
{
    return "looking towards " + sideName(pose.forward) + " (" + lettersFor(pose.forward) + ")";
}

}  // namespace

Overlay endoscopicOverlay(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    Overlay overlay;
    const Lens lens{request.view_angle_deg, request.width, request.height};
    const Area area{0, 0, double(request.width), double(request.height)};
    const double text_px = textHeightFor(request.width, request.height, request.pixel_ratio);
    addMarkers(overlay, scan, request, place.pose, lens, text_px);
    addLetters(overlay, area, place.pose.right(), -place.pose.up, text_px);
    addTriad(overlay, {4.2 * text_px, area.height - 4.2 * text_px}, 2.4 * text_px, place.pose, 0.9 * text_px);
    auto lines = captionLines(request.caption, place.station_mm, scan.frames().length_mm(), scan.words());
    OverlayText note;
    note.text = directionText(place.pose);
    if (request.look_at_mm)
        note.text += ", " + std::to_string(std::lround(distance(place.pose.eye_mm, *request.look_at_mm))) + " mm away";
    note.color = kTextColor;
    lines.push_back(note);
    if (!request.captioned)
        lines.clear();
    if (!request.peel.empty()) {
        note.text = peelingText(request);
        lines.push_back(note);
        if (request.peel_middle_only)
            overlay.discs.push_back({circleOf(request).centre, circleOf(request).radius_px, kTextColor, 1.5});
    }
    if (!place.sees_target) {
        note.text = "the marker lies behind the wall seen here";
        note.color = kWarningColor;
        lines.push_back(note);
    }
    const double above_letter_px = area.height / 2 - text_px;  // the one in the middle of the left edge
    addLines(overlay, {0, 0, area.width * 0.47, area.height}, lines,
             std::min(text_px, heightOfText(lines.size(), above_letter_px)));
    return overlay;
}

EndoscopicPictures::EndoscopicPictures(PreparedScan scan)
    : scan_(std::move(scan)), scene_(scan_.cells()), offscreen_(scene_.renderer())
{
}

Picture EndoscopicPictures::draw(const SnapshotRequest& request, const SnapshotResult& place)
{
    scene_.lookFrom(place.pose, request.view_angle_deg);
    scene_.setLampReach(lampReachAt_mm(scan_.frames(), place.station_mm));
    if (request.ambient_occlusion && !occluded_)
        scene_.shadeByOpenness(scan_.cells(), scan_.openness());
    if (!request.ambient_occlusion && occluded_)
        scene_.shadeEvenly();
    occluded_ = request.ambient_occlusion;
    Picture picture = offscreen_.render(request.width, request.height, kSmooth);
    finishEndoscopic(picture, scan_, request, place);
    return picture;
}

void castWall(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request, const Pose& pose)
{
    SnapshotRequest cast = request;
    cast.peel = "soft-tissue";
    cast.peeling.offset_mm = 0;
    cast.peel_middle_only = false;
    layPeelingOver(picture, scan, cast, pose);
}

void finishEndoscopic(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request,
                      const SnapshotResult& place)
{
    if (!request.peel.empty())
        layPeelingOver(picture, scan, request, place.pose);
    paint(picture, endoscopicOverlay(scan, request, place));
}

}  // namespace vicon::viewer

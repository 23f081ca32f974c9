#include <algorithm>
#include <cmath>

#include "caption_panel.h"
#include "pictures.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/slice_image.h"
#include "vicon/viewer/model/tracked_lumen.h"
#include "vicon/viewer/model/window_level.h"
#include "vicon/viewer/scene/reading_pictures.h"

namespace vicon::viewer {
namespace {

constexpr double kMarkerNear_mm = 5;  // a marker is drawn in slices that pass this near to it
constexpr double kRing_mm = 8;
constexpr std::size_t kNoteLine = 44;  // characters
constexpr std::size_t kMostNoteLines = 3;
constexpr double kLongestTitle = 10.5, kLongestTitleOfPicture = 9;  // in heights of the text: "sagittal, x = -123 mm"
constexpr double kCloseUp_mm = 50;  // what the close-up shows: a polyp of 6 mm fills an eighth of it

/// @param cleansed shown where it has densities; nothing: nowhere
Picture greyPicture(const HuView& volume, const HuView* cleansed, const PlaneView& view, const WindowLevel& window,
                    const ThickSlice& thick = {}, const Progress* wanted = nullptr)
{
    Picture picture(view.width, view.height);
    const auto densities = thickSliceDensities(volume, cleansed, view, thick, wanted);
    for (std::size_t n = 0; n < densities.size(); ++n)
        std::fill_n(picture.rgb.begin() + std::ptrdiff_t(3 * n), 3, window.greyOf(densities[n]));
    return picture;
}

constexpr Rgb kLumenRimColor{40, 205, 190};  // of no marker, and neither grey nor the eye's
constexpr double kEyeNear_mm = 10;  // farther from the slice, the lumen around the eye may be another one there

/// The rim of the lumen around the eye, which the reader follows.
void drawRim(Picture& picture, const InsideView& inside, const SliceRequest& request)
{
    if (std::abs(request.view.depth_mm(request.pose.eye_mm)) > kEyeNear_mm)
        return;
    const auto rim = lumenRim(inside, request.view, request.pose.eye_mm);
    for (std::size_t n = 0; n < rim.size(); ++n) {
        const auto mixed = [&](std::size_t c, std::uint8_t color) {
            std::uint8_t& own = picture.rgb[3 * n + c];
            own = std::uint8_t(std::lround(std::lerp(double(own), double(color), double(rim[n]))));
        };
        mixed(0, kLumenRimColor.red);
        mixed(1, kLumenRimColor.green);
        mixed(2, kLumenRimColor.blue);
    }
}

/// Which densities are shown, where there are two kinds or the other kind was asked for.
std::string wordFor(bool cleansable, bool asked)
{
    return cleansable && asked ? ", CLEANSED" : cleansable || asked ? ", as acquired" : "";
}

std::string titleOf(SlicePlane plane, Point3 point)
{
    if (plane == SlicePlane::across)
        return nameOf(plane);
    const double mm = plane == SlicePlane::axial ? point.z : plane == SlicePlane::coronal ? point.y : point.x;
    const char* axis = plane == SlicePlane::axial ? "z" : plane == SlicePlane::coronal ? "y" : "x";
    return nameOf(plane) + ", " + axis + " = " + std::to_string(std::lround(mm)) + " mm";
}

OverlayText plain(std::string words)
{
    OverlayText line;
    line.text = std::move(words);
    line.color = kTextColor;
    return line;
}

struct Panel {
    SlicePlane plane;
    Point3 point;
    int width, height;
    double field_mm;
    bool cross;
};

WindowLevel windowOf(const PreparedScan& scan, const SnapshotRequest& request)
{
    return request.window.empty() ? scan.windows().front() : scan.window(request.window);
}

Picture slice(const PreparedScan& scan, const SnapshotRequest& request, const Panel& panel)
{
    const auto& [plane, point, width, height, field_mm, cross] = panel;
    const HuView& volume = scan.volume();
    const PlaneView view = sliceThrough(volume.grid, plane, point, width, height, field_mm);
    Picture picture = greyPicture(volume, request.cleansed ? scan.cleansed() : nullptr, view, windowOf(scan, request));
    Overlay overlay;
    const Area area{0, 0, double(width), double(height)};
    const double text_px = textHeightFor(width, height, request.pixel_ratio) * 1.15;
    const double ring = std::max(kRing_mm / view.mm_per_pixel, 0.9 * text_px);
    if (cross)
        addCrosshair(overlay, area, view.toPixel(point), ring * 1.5);
    for (const Marker& marker : request.markers)
        if (std::abs(view.depth_mm(marker.position_mm) - view.depth_mm(point)) <= kMarkerNear_mm)
            addMarkerRing(overlay, view.toPixel(marker.position_mm), ring, marker, text_px);
    for (const PriorPlace& place : request.priors)
        addPriorDiamond(overlay, view, place, view.depth_mm(point), kMarkerNear_mm, ring, text_px);
    addLetters(overlay, area, view.right, view.down, text_px);
    addScaleBar(overlay, area, view.mm_per_pixel, text_px);
    addLines(overlay, {0, 0, area.width * 0.47, area.height}, {plain(cross ? titleOf(plane, point) : "close-up")},
             text_px);
    paint(picture, overlay);
    return picture;
}

std::vector<OverlayText> linesOf(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    std::vector<OverlayText> lines;
    if (request.captioned)
        lines = captionLines(request.caption, place.station_mm, scan.frames().length_mm(), scan.words());
    const WindowLevel window = windowOf(scan, request);
    OverlayText line;
    line.color = kTextColor;
    line.text = "window " + window.name + ": " + window.words() + wordFor(scan.cleansed() != nullptr, request.cleansed);
    lines.push_back(line);
    if (!request.captioned)
        return lines;
    for (const Marker& marker : request.markers)
        if (request.look_at_mm && marker.position_mm == *request.look_at_mm) {
            line.color = labelColorOf(marker.color);
            for (const std::string& words : wrapped(marker.id + "  " + marker.note, kNoteLine, kMostNoteLines)) {
                line.text = words;
                lines.push_back(line);
            }
        }
    return lines;
}

// The fourth quarter of the picture.
Picture captionAndCloseUp(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place,
                          Point3 point, int width, int height)
{
    Picture picture(width, height, {10, 12, 16});
    const CaptionPanel panel = captionPanel(linesOf(scan, request, place), width, height, request.pixel_ratio);
    if (const Area& room = panel.close_up; room.width > 0)
        copyInto(
            picture,
            slice(scan, request, {SlicePlane::axial, point, int(room.width), int(room.height), kCloseUp_mm, false}),
            int(room.x), int(room.y));
    paint(picture, panel.overlay);
    return picture;
}

/// Below the plane's name, the more important ones first.
std::vector<OverlayText> linesOfSlice(const SliceRequest& request, bool cleansable)
{
    std::vector<OverlayText> lines = patientLines(request.caption);
    if (std::string thickness = nameOf(request.thick); !thickness.empty())
        lines.push_back(plain(std::move(thickness)));
    lines.push_back(plain(request.window.name + " " + request.window.words() + wordFor(cleansable, request.cleansed)));
    if (request.voxels_a_pixel > 0)
        lines.push_back(plain(request.voxels_a_pixel == 1 ? "pixel for pixel" : "half resolution"));
    if (request.caption.lossy)
        lines.push_back(plain("LOSSY COMPRESSION"));
    if (request.caption.lossy)
        lines.back().color = kWarningColor;
    return lines;
}

}  // namespace

Overlay sliceOverlay(const SliceRequest& request, bool cleansable)
{
    const PlaneView& view = request.view;
    Overlay overlay;
    const Area area{0, 0, double(view.width), double(view.height)};
    const double text_px =
        request.text_px > 0 ? request.text_px : textHeightFor(view.width, view.height, request.pixel_ratio) * 1.15;
    const double ring = std::max(kRing_mm / view.mm_per_pixel, 0.9 * text_px);
    addCrosshair(overlay, area, view.toPixel(request.point_mm), ring * 1.5);
    addHere(overlay, view, request.pose, 0.8 * text_px);
    for (const Marker& marker : request.markers)
        if (std::abs(view.depth_mm(marker.position_mm)) <= kMarkerNear_mm)
            addMarkerRing(overlay, view.toPixel(marker.position_mm), ring, marker, text_px);
    for (const PriorPlace& place : request.priors)
        addPriorDiamond(overlay, view, place, 0, kMarkerNear_mm, ring, text_px);
    addLetters(overlay, area, view.right, view.down, text_px);
    addScaleBar(overlay, area, view.mm_per_pixel, text_px);
    const Area caption =
        captionArea(area.width, area.height, text_px, request.text_px > 0 ? kLongestTitle : kLongestTitleOfPicture);
    addLines(overlay, caption, {plain(titleOf(request.plane, view.centre_mm))}, text_px);
    auto lines = linesOfSlice(request, cleansable);
    const double below_title_px = caption.y + 1.35 * text_px, above_letter_px = area.height / 2 - text_px;
    if (request.text_px > 0)
        leaveOut(lines, linesIn(above_letter_px - below_title_px, text_px));
    addLines(overlay, {0, below_title_px, area.width, area.height}, lines, text_px);
    return overlay;
}

Picture slicePicture(const HuView& volume, const SliceRequest& request, const HuView* cleansed,
                     const InsideView* inside, const Progress* wanted)
{
    Picture picture =
        greyPicture(volume, request.cleansed ? cleansed : nullptr, request.view, request.window, request.thick, wanted);
    if (request.tracks && inside)
        drawRim(picture, *inside, request);
    paint(picture, sliceOverlay(request, cleansed != nullptr));
    return picture;
}

Picture slicesPicture(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    constexpr int kGap_px = 2;
    const Point3 point = request.look_at_mm ? *request.look_at_mm : scan.frames().at(place.station_mm).position_mm;
    const int w = (request.width - kGap_px) / 2, h = (request.height - kGap_px) / 2;
    const int right = w + kGap_px, below = h + kGap_px;
    Picture picture(request.width, request.height, {60, 60, 60});
    const auto put = [&](SlicePlane plane, int x, int y) {
        copyInto(picture, slice(scan, request, {plane, point, w, h, request.slice_field_mm, true}), x, y);
    };
    put(SlicePlane::axial, 0, 0);
    put(SlicePlane::coronal, right, 0);
    put(SlicePlane::sagittal, 0, below);
    copyInto(picture, captionAndCloseUp(scan, request, place, point, w, h), right, below);
    return picture;
}

}  // namespace vicon::viewer

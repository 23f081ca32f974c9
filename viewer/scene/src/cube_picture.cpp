#include "vicon/viewer/scene/cube_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "pictures.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {
namespace {

/// Into the corner below the left face.
void addWallLines(Overlay& overlay, const CubeLayout& layout, const std::vector<OverlayText>& lines, double text_px)
{
    const Pixel face = layout.cornerOf(CubeFace::bottom);
    addLines(overlay, {0, face.y, face.x, face.x}, broken(lines, face.x, text_px), text_px);
}

/// What a face shows of a line through space, in as few lines as it can.
void addOnFace(Overlay& overlay, const CubeLayout& layout, CubeFace face, const Pose& eye,
               const std::vector<Point3>& through, Rgb color)
{
    constexpr double kSame_px = 1e-3;
    OverlayLine line{{}, color, 2, 0};
    const auto end = [&] {
        if (line.points.size() > 1)
            overlay.lines.push_back(line);
        line.points.clear();
    };
    for (std::size_t n = 1; n < through.size(); ++n) {
        const auto part = layout.partOn(face, eye, through[n - 1], through[n]);
        if (!part)
            continue;
        if (line.points.empty() ||
            std::hypot(line.points.back().x - part->first.x, line.points.back().y - part->first.y) > kSame_px) {
            end();
            line.points.push_back(part->first);
        }
        line.points.push_back(part->second);
    }
    end();
}

/// Over all faces; the label stands where the rings are highest.
void addCubeRings(Overlay& overlay, const CubeLayout& layout, const PreparedScan& scan, const PriorPlace& expected,
                  const Pose& eye, double text_px)
{
    const std::size_t before = overlay.lines.size();
    for (const std::vector<Point3>& ring : priorRings(expected, scan.frames(), scan.lumen(), eye.eye_mm))
        for (const CubeFace face : kCubeFaces)
            addOnFace(overlay, layout, face, eye, ring, expected.color);
    std::optional<Pixel> highest;
    for (std::size_t n = before; n < overlay.lines.size(); ++n)
        for (const Pixel at : overlay.lines[n].points)
            if (!highest || at.y < highest->y)
                highest = at;
    PriorPlace end = expected;
    end.label += ", to here";  // it lies between the rings, not in one
    if (highest)
        addPriorName(overlay, *highest, end, text_px);
}

std::string faceName(CubeFace face)
{
    switch (face) {
        case CubeFace::left:
            return "left";
        case CubeFace::front:
            return "front";
        case CubeFace::right:
            return "right";
        case CubeFace::back:
            return "back";
        case CubeFace::top:
            return "above";
        case CubeFace::bottom:
            return "below";
    }
    return {};
}

void shiftOverlay(Overlay& overlay, Pixel by)
{
    const auto move = [&](Pixel& p) { p = {p.x + by.x, p.y + by.y}; };
    for (OverlayLine& line : overlay.lines)
        std::for_each(line.points.begin(), line.points.end(), move);
    for (OverlayDisc& disc : overlay.discs)
        move(disc.centre);
    for (OverlayText& text : overlay.texts)
        move(text.at);
}

void appendOverlay(Overlay& overlay, const Overlay& more)
{
    overlay.lines.insert(overlay.lines.end(), more.lines.begin(), more.lines.end());
    overlay.discs.insert(overlay.discs.end(), more.discs.begin(), more.discs.end());
    overlay.texts.insert(overlay.texts.end(), more.texts.begin(), more.texts.end());
}

}  // namespace

SnapshotRequest faceRequest(const SnapshotRequest& of_cube, const CubeLayout& layout)
{
    SnapshotRequest request = of_cube;
    request.width = request.height = layout.side();
    request.view_angle_deg = layout.lens().view_angle_deg;
    request.peel.preset.clear();
    return request;
}

SnapshotResult faceOf(CubeFace face, SnapshotResult place)
{
    place.pose = poseOf(face, place.pose);
    return place;
}

void placeFace(Picture& cube, const CubeLayout& layout, CubeFace face, const Picture& picture)
{
    const Pixel corner = layout.cornerOf(face);
    copyInto(cube, picture, int(corner.x), int(corner.y));
}

Overlay cubeOverlay(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    const CubeLayout layout(request.width, request.height);
    constexpr double kLeast_px = 11;
    const double usual_px = std::max(0.8 * textHeightFor(request.width, request.height, request.pixel_ratio),
                                     kLeast_px * request.pixel_ratio);
    const double text_px = request.text_px > 0 ? request.text_px : usual_px;
    Overlay overlay;
    for (const PriorPlace& expected : request.priors)
        addCubeRings(overlay, layout, scan, expected, place.pose, text_px);
    for (const CubeFace face : kCubeFaces) {
        const Pose pose = poseOf(face, place.pose);
        Overlay of_face;
        addMarkersInView(of_face, scan, request, pose, layout.lens(), text_px);
        of_face.texts.push_back({{0.4 * text_px, 0.3 * text_px},
                                 faceName(face) + " (" + lettersFor(pose.forward) + ")",
                                 text_px,
                                 kLetterColor});
        shiftOverlay(of_face, layout.cornerOf(face));
        appendOverlay(overlay, of_face);
    }
    if (request.captioned) {
        const auto lines = captionLines(request.caption, place.station_mm, scan.frames().length_mm(), scan.words());
        const double right = layout.cornerOf(CubeFace::top).x, bottom = layout.cornerOf(CubeFace::left).y;
        addLines(overlay, {0, 0, right, bottom}, lines, std::min(text_px, heightOfText(lines.size(), bottom)));
    }
    addWallLines(overlay, layout, linesOfWall(scan, request.wall, place), text_px);
    return overlay;
}

}  // namespace vicon::viewer

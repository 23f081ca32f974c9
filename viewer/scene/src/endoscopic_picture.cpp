#include <algorithm>
#include <cstdio>

#include "cast_wall.h"
#include "pictures.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/acquired_wall.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/orientation.h"
#include "vicon/viewer/scene/cube_picture.h"

namespace vicon::viewer {
namespace {

constexpr int kSmooth = 2;
constexpr double kRing_mm = 8;           // a ring that leaves a polyp of 10 mm free
constexpr double kMarkerReach_mm = 150;  // further off a marker is too small to mean anything
constexpr double kSightSlack_mm = 2.5;
constexpr double kLeastForTriad = 17;  // heights of text: in a lower view it lies on the caption
// In heights of the text. A window's text keeps its size, a picture's is made smaller where it does not fit.
constexpr double kLongestLine = 24, kLongestLineOfPicture = 8.6;

std::string peelingText(const SnapshotRequest& request)
{
    char offset[32];
    const double offset_mm = request.peel.options.offset_mm;
    std::snprintf(offset, sizeof offset, "%.1f", std::abs(offset_mm));
    return "translucent: " + transferFunction(request.peel.preset).title + ", " + offset + " mm " +
           (offset_mm < 0 ? "before" : "deep") + (request.peel.over_surface ? ", over" : "");
}

std::string directionText(const Pose& pose)
{
    return "looking towards " + sideName(pose.forward) + " (" + lettersFor(pose.forward) + ")";
}

std::vector<OverlayText> linesOfPlace(const PreparedScan& scan, const SnapshotRequest& request,
                                      const SnapshotResult& place)
{
    auto lines = captionLines(request.caption, place.station_mm, scan.frames().length_mm(), scan.words());
    OverlayText line;
    line.color = kTextColor;
    line.text = directionText(place.pose);
    if (request.look_at_mm)
        line.text += ", " + std::to_string(std::lround(distance(place.pose.eye_mm, *request.look_at_mm))) + " mm away";
    lines.push_back(line);
    if (line.text = partNameAt(scan.parts(), place.station_mm); !line.text.empty())
        lines.insert(lines.begin() + std::ptrdiff_t(patientLines(request.caption).size()), line);
    return lines;
}

std::vector<OverlayText> linesOfPicture(const PreparedScan& scan, const SnapshotRequest& request,
                                        const SnapshotResult& place)
{
    std::vector<OverlayText> lines;
    OverlayText line;
    if (!request.peel.preset.empty()) {
        line.text = peelingText(request);
        line.color = kTextColor;
        lines.push_back(line);
    }
    constexpr int kInAList_px = 200;  // a picture as small as that has no room for words
    if (request.width > kInAList_px)
        for (const OverlayText& of_wall : linesOfWall(scan, request.wall, place))
            lines.push_back(of_wall);
    constexpr double kFills = 0.9;  // of the picture: no lumen is seen, and no wall
    if (request.wall.acquired && standingShare(scan.volume(), scan.gasEnds_hu(), scan.lumen(), place.pose,
                                               {request.view_angle_deg, request.width, request.height}) > kFills) {
        line.text = "fluid or stool fills the view: no wall is seen";
        line.color = kWarningColor;
        lines.push_back(line);
    }
    if (!place.sees_target) {
        line.text = "the marker lies behind the wall seen here";
        line.color = kWarningColor;
        lines.push_back(line);
    }
    return lines;
}

}  // namespace

std::vector<OverlayText> linesOfWall(const PreparedScan& scan, const WallLook& look, const SnapshotResult& place)
{
    std::vector<OverlayText> lines;
    OverlayText line;
    if (scan.canBeCleansed()) {
        line.text = look.acquired ? "AS ACQUIRED" : "cleansed";
        line.color = kTextColor;
        lines.push_back(line);
    }
    if (look.acquired && !startsInGas(scan.volume(), scan.gasEnds_hu(), place.pose.eye_mm)) {
        line.text = "the eye is not in gas: as acquired there is nothing to see";
        line.color = kWarningColor;
        lines.push_back(line);
    } else if (!look.acquired && look.tagging && scan.hasTagging() && !scan.tagging().empty()) {
        line.text = "blue: tagging on the wall";
        if (scan.hasUntrustedWall())
            line.text += "; violet: wall not sure";
        line.color = kTextColor;
        lines.push_back(line);
    }
    return lines;
}

void addMarkersInView(Overlay& overlay, const PreparedScan& scan, const SnapshotRequest& request, const Pose& pose,
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

Overlay endoscopicOverlay(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    Overlay overlay;
    const Lens lens{request.view_angle_deg, request.width, request.height};
    const Area area{0, 0, double(request.width), double(request.height)};
    const double text_px =
        request.text_px > 0 ? request.text_px : textHeightFor(request.width, request.height, request.pixel_ratio);
    for (const PriorPlace& expected : request.priors)
        addPriorRings(overlay, expected, scan.frames(), scan.lumen(), place.pose, lens, text_px);
    addMarkersInView(overlay, scan, request, place.pose, lens, text_px);
    if (request.captioned || request.text_px > 0)  // a picture of a list is too small for letters
        addLetters(overlay, area, place.pose.right(), -place.pose.up, text_px);
    const bool tall = area.height >= kLeastForTriad * text_px;
    if (request.captioned && (tall || request.text_px == 0))
        addTriad(overlay, {4.2 * text_px, area.height - 4.2 * text_px}, 2.4 * text_px, place.pose, 0.9 * text_px);
    auto lines = request.captioned ? linesOfPlace(scan, request, place) : std::vector<OverlayText>();
    auto more = linesOfPicture(scan, request, place);
    const double above_letter_px = area.height / 2 - text_px;  // the one in the middle of the left edge
    const bool window = request.text_px > 0;
    const Area caption = captionArea(area.width, area.height, text_px, window ? kLongestLine : kLongestLineOfPicture);
    const int room = linesIn(above_letter_px - caption.y, text_px);
    if (window) {  // the lines that go are said by other views
        lines = broken(lines, caption.width, text_px);
        const auto whole = broken(more, caption.width, text_px);
        more = int(whole.size()) < room ? whole : broken(more, caption.width, text_px, 1);
        leaveOut(lines, room - int(more.size()));
    }
    lines.insert(lines.end(), more.begin(), more.end());
    if (request.peel.middle_only && !request.peel.preset.empty())
        overlay.discs.push_back({peeledCircle(request).centre, peeledCircle(request).radius_px, kTextColor, 1.5});
    if (window)
        leaveOut(lines, room);
    const double fitting_px = heightOfText(lines.size(), above_letter_px - caption.y);
    addLines(overlay, caption, lines, window ? text_px : std::min(text_px, fitting_px));
    return overlay;
}

EndoscopicPictures::EndoscopicPictures(PreparedScan scan)
    : scan_(std::move(scan)), scene_(scan_.cells()), offscreen_(scene_.renderer())
{
}

EndoscopicPictures::EndoscopicPictures(PreparedScan scan, std::shared_ptr<const SeenSurface> seen)
    : scan_(std::move(scan)), seen_(std::move(seen)), scene_(seen_->cells), offscreen_(scene_.renderer())
{
}

void EndoscopicPictures::chooseCells(const Pose& pose, const Lens& lens)
{
    if (!seen_)
        return;
    const SeenSurface::From* place = seen_->from(pose, lens);
    if (!place)
        throw Error(ErrorCode::internal, "a picture was asked for from a place that was not prepared");
    scene_.showOnly(place->segments);
}

void EndoscopicPictures::wear(const WallLook& look)
{
    if (!seen_) {
        look_.wear(scene_, look, scan_);
        return;
    }
    const CellSurface& cells = seen_->cells;
    look_.wear(
        scene_, look, cells, [&]() -> const std::vector<float>& { return seen_->openness; },
        [&]() -> const std::vector<float>& {
            tagging_ = scan_.taggingOf(cells);
            return tagging_;
        });
}

const Picture& EndoscopicPictures::wall(const SnapshotRequest& request, const SnapshotResult& place)
{
    const Lens lens{request.view_angle_deg, request.width, request.height};
    if (last_ && last_->pose == place.pose && last_->lens == lens && last_->look == request.wall)
        return last_->picture;
    if (request.wall.acquired) {
        last_ = {place.pose, lens, request.wall, Picture(request.width, request.height)};
        castWall(last_->picture, scan_, request, place);
        return last_->picture;
    }
    chooseCells(place.pose, lens);
    scene_.lookFrom(place.pose, request.view_angle_deg);
    scene_.setLampReach(lampReachAt_mm(scan_.frames(), place.station_mm));
    wear(request.wall);
    last_ = {place.pose, lens, request.wall, offscreen_.render(request.width, request.height, kSmooth)};
    return last_->picture;
}

Picture EndoscopicPictures::draw(const SnapshotRequest& request, const SnapshotResult& place)
{
    Picture picture = wall(request, place);
    finishEndoscopic(picture, scan_, request, place);
    return picture;
}

Picture EndoscopicPictures::drawCube(const SnapshotRequest& request, const SnapshotResult& place)
{
    Picture picture(request.width, request.height);
    const CubeLayout layout(request.width, request.height);
    for (const CubeFace face : kCubeFaces)
        placeFace(picture, layout, face, wall(faceRequest(request, layout), faceOf(face, place)));
    paint(picture, cubeOverlay(scan_, request, place));
    return picture;
}

void finishEndoscopic(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request,
                      const SnapshotResult& place, const Progress* wanted)
{
    if (!request.peel.preset.empty())
        layPeelingOver(picture, scan, request, place, wanted);
    paint(picture, endoscopicOverlay(scan, request, place));
}

}  // namespace vicon::viewer

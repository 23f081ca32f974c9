#include <algorithm>

#include "pictures.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/orientation.h"

namespace vicon::viewer {
namespace {

constexpr int kSmooth = 2;

struct Extent {
    double low = 1e300, high = -1e300;
    void add(double v)
    {
        low = std::min(low, v);
        high = std::max(high, v);
    }
    double middle() const { return (low + high) / 2; }
    double size() const { return high - low; }
};

// In a window the projection is small, its words are not.
double captionHeight(double text_px)
{
    constexpr double kLeast_px = 11;
    return std::max(0.8 * text_px, kLeast_px);
}

// The whole surface with the caption's room above it and a margin for letters.
PlaneView viewOfAll(const artefact::CellSurface& surface, int width, int height, double header_px, double margin_px)
{
    std::array<Extent, 3> extent;
    for (std::size_t n = 0; n < surface.pointCount(); ++n) {
        const Point3 p = surface.point(n);
        extent[0].add(p.x);
        extent[1].add(p.y);
        extent[2].add(p.z);
    }
    const SliceAxes axes = axesOf(SlicePlane::coronal);
    const double room_x = width - 2 * margin_px, room_y = height - 2 * margin_px - header_px;
    PlaneView view{{},    axes.right, axes.down, std::max(extent[0].size() / room_x, extent[2].size() / room_y),
                   width, height};
    const Point3 middle{extent[0].middle(), extent[1].middle(), extent[2].middle()};
    view.centre_mm = middle - axes.down * (header_px / 2 * view.mm_per_pixel);
    return view;
}

void addTips(Overlay& overlay, const Skeleton& skeleton, const PlaneView& view, double text_px)
{
    const Pixel rectum = view.toPixel(skeleton.at(0).position_mm);
    const Pixel caecum = view.toPixel(skeleton.at(skeleton.length_mm()).position_mm);
    for (const auto& [at, name] : {std::pair{rectum, "rectum"}, std::pair{caecum, "caecum"}}) {
        overlay.discs.push_back({at, 0.25 * text_px, kPathColor, 0});
        overlay.texts.push_back(
            {{at.x, at.y + 0.4 * text_px}, name, 0.9 * text_px, kPathColor, Across::centre, Along::top, 1e9});
    }
}

/// The parts between rectum and caecum, whose names stand at the tips: each in its middle, a dot where one begins.
void addParts(Overlay& overlay, const ColonPartRanges& parts, const Skeleton& skeleton, const PlaneView& view,
              double text_px)
{
    for (const ColonPartRange& range : parts) {
        if (range.part != ColonPart::rectum)
            overlay.discs.push_back(
                {view.toPixel(skeleton.at(range.from_mm).position_mm), 0.2 * text_px, kPathColor, 0});
        if (range.part == ColonPart::rectum || range.part == ColonPart::caecum)
            continue;
        const Pixel middle = view.toPixel(skeleton.at((range.from_mm + range.to_mm) / 2).position_mm);
        overlay.texts.push_back(
            {middle, nameOf(range.part), 0.9 * text_px, kPathColor, Across::centre, Along::bottom, 1e9});
    }
}

void addMarkers(Overlay& overlay, const std::vector<Marker>& markers, const PlaneView& view, double text_px)
{
    for (const Marker& marker : markers) {
        const Pixel at = view.toPixel(marker.position_mm);
        overlay.discs.push_back({at, 0.38 * text_px, colorOf(marker.color), 0});
        overlay.texts.push_back({{at.x + 0.5 * text_px, at.y - 0.2 * text_px},
                                 marker.id,
                                 text_px,
                                 colorOf(marker.color),
                                 Across::left,
                                 Along::bottom,
                                 1e9});
    }
}

}  // namespace

OverviewGround overviewGround(const PreparedScan& scan, const SnapshotRequest& request, SurfaceScene& scene,
                              Offscreen& offscreen)
{
    const double text_px = textHeightFor(request.width, request.height);
    OverviewGround ground;
    ground.header_px =
        double(captionLines(request.caption, 0, 0).size()) * 1.35 * captionHeight(text_px) + 0.48 * text_px;
    ground.view = viewOfAll(scan.cells(), request.width, request.height, ground.header_px, 2.2 * text_px);
    scene.lookOnto(ground.view);
    ground.picture = offscreen.render(request.width, request.height, kSmooth);
    return ground;
}

Picture overviewOver(const OverviewGround& ground, const PreparedScan& scan, const SnapshotRequest& request,
                     const SnapshotResult& place)
{
    const PlaneView& view = ground.view;
    const double text_px = std::max(textHeightFor(request.width, request.height), 12.0);
    const auto lines = captionLines(request.caption, place.station_mm, scan.frames().length_mm());
    Picture picture = ground.picture;
    Overlay overlay;
    const Area area{0, 0, double(request.width), double(request.height)};
    addSkeleton(overlay, scan.skeleton(), view, std::max(1.5, text_px / 9));
    addTips(overlay, scan.skeleton(), view, text_px);
    addParts(overlay, scan.parts(), scan.skeleton(), view, text_px);
    addMarkers(overlay, request.markers, view, text_px);
    addHere(overlay, view, place.pose, 0.8 * text_px);
    addLetters(overlay, area, view.right, view.down, text_px);
    addScaleBar(overlay, area, view.mm_per_pixel, text_px);
    addLines(overlay, {0, 0, area.width * 0.47, ground.header_px}, lines, captionHeight(text_px));
    paint(picture, overlay);
    return picture;
}

Picture overviewPicture(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    SurfaceScene scene(scan.cells());
    Offscreen offscreen(scene.renderer());
    return overviewOver(overviewGround(scan, request, scene, offscreen), scan, request, place);
}

}  // namespace vicon::viewer

#include "vicon/viewer/scene/reading_pictures.h"

#include <chrono>
#include <optional>
#include <utility>

#include "cast_wall.h"
#include "pictures.h"
#include "reviewed_wall.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/annotate.h"
#include "vicon/viewer/model/peeling_pace.h"
#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/cube_picture.h"
#include "vicon/viewer/scene/picture_coverage.h"

namespace vicon::viewer {

struct ReadingPictures::Parts {
    PreparedScan scan;
    std::shared_ptr<const CellVisibility> visibility;
    SurfaceScene scene;
    std::optional<Offscreen> offscreen;  // nothing: there is no OpenGL
    OverviewGround ground;
    /// What of the wall is painted on it.
    struct Painted {
        ReviewedWall wall;
        double area_mm2 = 0;
        std::chrono::steady_clock::time_point at{};
    };
    std::optional<Painted> painted;
    /// What the last endoscopic picture showed.
    struct Shown {
        VisibleParts parts;
        Pose pose;
        Lens lens;
        double pixel_ratio = 1;
        bool told = false;  ///< picture_coverage has looked at it
    };
    std::optional<Shown> shown;
    PeelingPace pace;
    SceneLook wall_look;
    bool cells_colored = false;
    double lamp_reach_mm = kUsualLampReach_mm;
    std::optional<PictureCoverage> picture_coverage;  // made when it is first asked for

    /// What is begun is painted to its end: a ground painted in part is none.
    void paintOverview(const ScanCoverage& reviewed, bool still, const Progress* wanted)
    {
        constexpr std::chrono::milliseconds kAgain(500);
        const auto now = std::chrono::steady_clock::now();
        const double area_mm2 = reviewed.seenArea_mm2();
        if (!painted)
            painted.emplace(Painted{ReviewedWall(scan.cells(), ground.view)});
        if (area_mm2 == painted->area_mm2 || (!still && now - painted->at < kAgain))
            return;
        if (wanted)
            wanted->check();
        painted->wall.see(reviewed.seenTriangles());
        painted->area_mm2 = area_mm2;
        painted->at = now;
        paintReviewed(ground, painted->wall);
    }

    PictureCoverage& pictureCoverage()
    {
        if (!picture_coverage)
            picture_coverage.emplace(scan);
        if (!shown->told)
            picture_coverage->look(shown->parts, shown->pose, shown->lens);
        shown->told = true;
        return *picture_coverage;
    }

    /// Casts rays; while the eye moves as coarsely as ten pictures a second ask for.
    template <class Cast>
    void cast(SnapshotRequest request, bool still, Cast how)
    {
        if (still) {
            how(request);
            return;
        }
        request.peel.options = request.peel.options.whileMoving();
        request.peel.coarse = pace.coarseFor(request.width, request.height);
        const auto begin = std::chrono::steady_clock::now();
        how(request);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        pace.tell(request.width, request.height, request.peel.coarse, took.count());
    }

    /// Whether the surface itself is drawn, so that what the picture shows can be known.
    bool shows(const SnapshotRequest& request) const { return offscreen && !request.wall.acquired; }

    /// What is peeled, and written on.
    Picture wall(const SnapshotRequest& request, const SnapshotResult& place, bool still, const Progress* wanted)
    {
        if (shows(request))
            return offscreen->render(request.width, request.height, still ? 2 : 1);
        Picture picture(request.width, request.height);
        cast(request, still, [&](const SnapshotRequest& as) { castWall(picture, scan, as, place, wanted); });
        return picture;
    }

    /// The wall, tinted, with what is translucent and what is written.
    Picture wallAndBelow(const SnapshotRequest& request, const SnapshotResult& place, bool still,
                         const EndoscopicLook& look)
    {
        // Then nothing of the wall is left.
        const bool only_peeled =
            !request.peel.preset.empty() && !request.peel.middle_only && !request.peel.over_surface;
        Picture picture =
            only_peeled ? Picture(request.width, request.height) : wall(request, place, still, look.wanted);
        if (look.earlier && !only_peeled && shows(request))
            pictureCoverage().tint(picture, look.earlier->earlier());
        if (look.missed && !only_peeled && shows(request))
            pictureCoverage().tint(picture, *look.missed, PictureCoverage::Tint::missed);
        cast(request, still || request.peel.preset.empty(),
             [&](const SnapshotRequest& as) { finishEndoscopic(picture, scan, as, place, look.wanted); });
        return picture;
    }

    /// Shadows and tints come when they are known: no picture waits for them.
    void setLook(bool color_cells, double reach_mm, WallLook wall)
    {
        wall.ambient_occlusion = wall.ambient_occlusion && scan.hasOpenness();
        wall.tagging = wall.tagging && scan.hasTagging();
        wall_look.wear(scene, wall, scan);
        if (cells_colored != color_cells)
            scene.colorCells(color_cells);
        if (lamp_reach_mm != reach_mm)
            scene.setLampReach(reach_mm);
        cells_colored = color_cells;
        lamp_reach_mm = reach_mm;
    }

    /// What the next picture shows.
    Lens look(const SnapshotRequest& request, const SnapshotResult& place, const EndoscopicLook& how)
    {
        const Lens lens{request.view_angle_deg, request.width, request.height};
        shown = Shown{visibility->visibleFrom(place.pose, lens), place.pose, lens, request.pixel_ratio};
        setLook(how.structure, how.lamp_factor * lampReachAt_mm(scan.frames(), place.station_mm), request.wall);
        scene.showSeen(shown->parts);
        scene.lookFrom(place.pose, request.view_angle_deg);
        return lens;
    }

    explicit Parts(const PreparedScan& of)
        : scan(of), visibility(std::make_shared<CellVisibility>(of, CellVisibility::Means::gates)), scene(of.cells())
    {
        try {
            offscreen.emplace(scene.renderer());
        } catch (const Error& e) {
            if (e.code() != ErrorCode::no_display)
                throw;
        }
    }
};

namespace {

constexpr Rgb kGateColor{255, 235, 60};

std::string drawnText(const SurfaceScene& scene)
{
    return std::to_string(scene.cellsShown()) + " of " + std::to_string(scene.cellCount()) + " cells, " +
           std::to_string(scene.trianglesShown()) + " of " + std::to_string(scene.triangleCount()) + " triangles drawn";
}

/// The rectangles through which each cell may be seen, and the figures.
Overlay structureOverlay(const CellVisibility& visibility, const SurfaceScene& scene, const Pose& pose,
                         const Lens& lens)
{
    Overlay overlay;
    const auto at = [&](double x, double y) {
        return Pixel{lens.width / 2.0 + x * lens.focal_px(), lens.height / 2.0 - y * lens.focal_px()};
    };
    if (const int start = visibility.segmentAt(pose.eye_mm); start > 0)
        for (const VisibleSegment& seen : visibility.visibility().visibleFrom(pose, lens, start))
            for (const ViewRectangle& r : seen.through)
                if (seen.segment != start && !r.empty())
                    overlay.lines.push_back({{at(r.left, r.top), at(r.right, r.top), at(r.right, r.bottom),
                                              at(r.left, r.bottom), at(r.left, r.top)},
                                             kGateColor,
                                             1.5,
                                             0});
    const double text_px = 0.8 * textHeightFor(lens.width, lens.height);
    constexpr double kAboveLetters = 2.6;  // in heights of the text
    overlay.texts.push_back({{lens.width - text_px, lens.height - kAboveLetters * text_px},
                             drawnText(scene),
                             text_px,
                             kGateColor,
                             Across::right,
                             Along::bottom,
                             lens.width * 0.6});
    return overlay;
}

}  // namespace

ReadingPictures::ReadingPictures(const PreparedScan& scan) : parts_(std::make_unique<Parts>(scan)) {}
ReadingPictures::~ReadingPictures() = default;

bool ReadingPictures::hasOpenGl() const
{
    return parts_->offscreen.has_value();
}

Picture ReadingPictures::endoscopic(const SnapshotRequest& request, const SnapshotResult& place, bool still,
                                    const EndoscopicLook& look)
{
    Parts& p = *parts_;
    auto on_screen = std::move(p.shown);
    const Lens lens = p.look(request, place, look);
    Picture picture;
    try {
        picture = p.wallAndBelow(request, place, still, look);
    } catch (const Error&) {
        p.shown.reset();  // nobody sees it
        throw;
    }
    if (look.structure)
        paint(picture, structureOverlay(*p.visibility, p.scene, place.pose, lens));
    if ((!request.peel.preset.empty() && !request.peel.over_surface) || !p.shows(request))
        p.shown.reset();
    if (!look.on_screen) {
        p.shown = std::move(on_screen);
        if (p.shown)
            p.shown->told = false;
    }
    return picture;
}

Picture ReadingPictures::cubeFace(const SnapshotRequest& of_cube, const SnapshotResult& place, CubeFace face,
                                  bool still, const EndoscopicLook& look, ScanCoverage* seen)
{
    Parts& p = *parts_;
    auto before = std::move(p.shown);  // the endoscopic picture, which may still be asked for
    const SnapshotRequest request = faceRequest(of_cube, {of_cube.width, of_cube.height});
    const SnapshotResult turned = faceOf(face, place);
    p.look(request, turned, look);
    Picture picture = p.wall(request, turned, still, look.wanted);
    if (look.earlier && p.shows(request))
        p.pictureCoverage().tint(picture, look.earlier->earlier());
    if (seen && p.shows(request))
        seen->see(p.pictureCoverage().triangles());
    p.shown = std::move(before);
    if (p.shown)
        p.shown->told = false;
    return picture;
}

void ReadingPictures::chooseBy(std::shared_ptr<const CellVisibility> visibility)
{
    Parts& p = *parts_;
    p.visibility = std::move(visibility);
    if (!p.offscreen)
        return;
    // Flying begins now: what comes into sight on the way shall not hold it up.
    constexpr int kSmall = 16;
    p.scene.sendAll();
    p.offscreen->draw(kSmall, kSmall);
}

void ReadingPictures::countSeen(ScanCoverage& seen, double now_s)
{
    Parts& p = *parts_;
    if (!p.shown)
        return;
    const CellSurface& cells = p.scan.cells();
    seen.show(wellShown(cells.points_mm, cells.triangles, p.pictureCoverage().triangles(), p.shown->pose, p.shown->lens,
                        p.shown->pixel_ratio),
              now_s, kLeastShown_s);
}

ReadingPictures::Overview ReadingPictures::overview(const SnapshotRequest& request, const SnapshotResult& place,
                                                    const ScanCoverage* reviewed, bool still, const Progress* wanted)
{
    Parts& p = *parts_;
    if (p.ground.picture.width != request.width || p.ground.picture.height != request.height) {
        p.ground = overviewGround(p.scan, request, wanted);
        p.painted.reset();
    }
    if (reviewed)
        p.paintOverview(*reviewed, still, wanted);
    if (wanted)
        wanted->check();
    return {overviewOver(p.ground, p.scan, request, place), p.ground.view};
}

}  // namespace vicon::viewer

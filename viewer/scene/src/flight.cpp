#include "vicon/viewer/scene/flight.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "pictures.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/viewer/model/coverage.h"
#include "vicon/viewer/model/flight_plan.h"
#include "vicon/viewer/model/review_rule.h"
#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/id_scene.h"
#include "vicon/viewer/scene/sight_ahead.h"

namespace vicon::viewer {
namespace {

constexpr int kSide_px = 512;

struct Leg {
    Heading heading;
    std::vector<ViewPose> poses;
};

std::vector<Leg> legsOf(const PreparedScan& scan, const FlightRequest& request)
{
    const double step = request.frames > 1    ? scan.frames().length_mm() / (request.frames - 1)
                        : request.frames == 1 ? scan.frames().length_mm() * 2
                                              : request.step_mm;
    const Lumen lumen = scan.lumen();
    std::vector<Leg> legs;
    for (const Heading heading : {Heading::caecum, Heading::rectum}) {
        const bool wanted = request.direction == FlightDirection::both ||
                            (request.direction == FlightDirection::to_caecum) == (heading == Heading::caecum);
        if (wanted)
            legs.push_back({heading, planFlight(scan.frames(), lumen, step, heading)});
    }
    return legs;
}

// What draws the frames of a flight; the id buffer only where coverage is measured.
struct FlightRenderer {
    const PreparedScan& scan;
    FlightRequest request;
    SurfaceScene scene;
    Offscreen offscreen;
    std::optional<IdScene> ids;
    std::optional<Offscreen> ids_offscreen;
    std::optional<CellVisibility> visibility;
    std::optional<SightAhead> ahead;
    Coverage coverage, reviewed;

    FlightRenderer(const PreparedScan& s, const FlightRequest& r)
        : scan(s),
          request(r),
          scene(s.cells()),
          offscreen(scene.renderer()),
          coverage(triangleAreas_mm2(s.cells().points_mm, s.cells().triangles)),
          reviewed(coverage)
    {
        SceneLook().wear(scene, request.wall, s);
        if (request.measure_coverage) {
            ids.emplace(s.cells());
            ids_offscreen.emplace(ids->renderer());
        }
        if (request.cull)
            ahead.emplace(visibility.emplace(s));
    }

    Lens lens() const { return {request.view_angle_deg, request.width, request.height}; }
    void prepare(const ViewPose& next)
    {
        if (ahead)
            ahead->prepare(next.pose, lens());
    }
    VisibleParts visibleFrom(const ViewPose& view)
    {
        return ahead ? ahead->visibleFrom(view.pose, lens()) : VisibleParts{};
    }
    FlightFrame shoot(const ViewPose& view, const VisibleParts& shown, Heading heading,
                      const std::filesystem::path& png);
};

FlightFrame FlightRenderer::shoot(const ViewPose& view, const VisibleParts& shown, Heading heading,
                                  const std::filesystem::path& png)
{
    FlightFrame frame{view.pose, view.station_mm, view.clearance_mm, heading == Heading::caecum, 0, 0, 0, 0};
    scene.showSeen(shown);
    scene.lookFrom(view.pose, request.view_angle_deg);
    scene.setLampReach(lampReachAt_mm(scan.frames(), view.station_mm));
    frame.cells_drawn = scene.cellsShown();
    frame.triangles_drawn = scene.trianglesShown();
    if (!png.empty()) {
        Picture picture = offscreen.render(request.width, request.height);
        frame.seconds = offscreen.seconds();
        SnapshotRequest still;
        still.markers = request.markers;
        still.caption = request.caption;
        still.width = request.width;
        still.height = request.height;
        still.view_angle_deg = request.view_angle_deg;
        still.wall = request.wall;
        paint(picture, endoscopicOverlay(scan, still, {view.pose, view.station_mm, view.clearance_mm, true}));
        writePng(png, picture);
    }
    if (ids) {
        ids->showOnly(shown.everything ? std::vector<int>{} : shown.segments);
        ids->lookFrom(view.pose, request.view_angle_deg);
        const auto seen = IdScene::trianglesIn(ids_offscreen->render(request.width, request.height));
        if (png.empty())
            frame.seconds = ids_offscreen->seconds();
        frame.triangles_seen = seen.size();
        coverage.see(seen);
        reviewed.see(wellShown(scan.cells().points_mm, scan.cells().triangles, seen, view.pose, lens()));
    }
    return frame;
}

std::vector<FlightLegQuality> qualityOf(const std::vector<Leg>& legs, const PreparedScan& scan, const Lens& lens)
{
    std::vector<FlightLegQuality> all;
    for (const Leg& leg : legs)
        all.push_back({leg.heading, qualityOf(leg.poses, leg.heading, scan.frames(), scan.lumen(), lens)});
    return all;
}

void summarise(FlightReport& report)
{
    const double count = std::max<double>(1, double(report.frames.size()));
    std::vector<double> seconds;
    for (const FlightFrame& frame : report.frames) {
        report.average_cells += double(frame.cells_drawn) / count;
        report.average_triangles += double(frame.triangles_drawn) / count;
        report.average_seen += double(frame.triangles_seen) / count;
        seconds.push_back(frame.seconds);
    }
    std::sort(seconds.begin(), seconds.end());
    report.median_seconds = seconds.empty() ? 0 : seconds[seconds.size() / 2];
    report.slow_seconds = seconds.empty() ? 0 : seconds[std::size_t(double(seconds.size() - 1) * 0.95)];
}

FlightRequest completed(FlightRequest request)
{
    request.width = request.width > 0 ? request.width : kSide_px;
    request.height = request.height > 0 ? request.height : kSide_px;
    for (const int side : {request.width, request.height})
        if (side < SnapshotRequest::kLeastSide || side > SnapshotRequest::kMostSide)
            throw Error(ErrorCode::wrong_use, "a frame's sides must be 200 to 4096 pixels", std::to_string(side));
    if (request.frames < 0 || (request.frames == 0 && !(request.step_mm > 0)))
        throw Error(ErrorCode::wrong_use, "a flight's step must be above 0 mm and its frames not below 0");
    if (!request.out.empty())
        makePrivateFolder(request.out);
    return request;
}

std::string frameName(std::size_t number)
{
    char name[32];
    std::snprintf(name, sizeof name, "frame-%05zu.png", number);
    return name;
}

nlohmann::json triple(double x, double y, double z)
{
    return {x, y, z};
}

nlohmann::json toJson(const std::vector<UnseenPatch>& patches, const ColonPartRanges& parts)
{
    nlohmann::json list = nlohmann::json::array();
    for (const UnseenPatch& patch : patches) {
        const Pose& p = patch.view.pose;
        list.push_back({{"area_mm2", patch.area_mm2},
                        {"centre_mm", triple(patch.centre_mm.x, patch.centre_mm.y, patch.centre_mm.z)},
                        {"station_mm", patch.station_mm},
                        {"part", partNameAt(parts, patch.station_mm)},
                        {"in_plain_view", patch.view.sees_target},
                        {"eye_mm", triple(p.eye_mm.x, p.eye_mm.y, p.eye_mm.z)},
                        {"forward", triple(p.forward.x, p.forward.y, p.forward.z)},
                        {"up", triple(p.up.x, p.up.y, p.up.z)}});
    }
    return list;
}

void addCoverage(FlightReport& report, const FlightRenderer& renderer)
{
    const PreparedScan& scan = renderer.scan;
    report.coverage = renderer.coverage.fraction();
    report.reviewed = renderer.reviewed.fraction();
    report.seen_mm2 = renderer.coverage.seenArea_mm2();
    report.whole_mm2 = renderer.coverage.wholeArea_mm2();
    report.parts = scan.parts();
    report.unseen = unseenPatches(scan.cells().points_mm, scan.cells().triangles, renderer.coverage, scan.skeleton(),
                                  scan.frames(), scan.lumen(), renderer.request.least_unseen_mm2);
}

const char* endName(const FlightReport& report, bool towards_caecum)
{
    if (report.tree)
        return towards_caecum ? "tip" : "root";
    return towards_caecum ? "caecum" : "rectum";
}

}  // namespace

nlohmann::json toJson(const FlightReport& report)
{
    nlohmann::json frames = nlohmann::json::array();
    for (const FlightFrame& f : report.frames) {
        const Pose& p = f.pose;
        frames.push_back({{"eye_mm", triple(p.eye_mm.x, p.eye_mm.y, p.eye_mm.z)},
                          {"forward", triple(p.forward.x, p.forward.y, p.forward.z)},
                          {"up", triple(p.up.x, p.up.y, p.up.z)},
                          {"station_mm", f.station_mm},
                          {"clearance_mm", f.clearance_mm},
                          {"towards", endName(report, f.towards_caecum)},
                          {"cells_drawn", f.cells_drawn},
                          {"triangles_drawn", f.triangles_drawn},
                          {"triangles_seen", f.triangles_seen},
                          {"seconds", f.seconds}});
    }
    nlohmann::json views = nlohmann::json::array();
    for (const FlightLegQuality& leg : report.views)
        views.push_back({{"towards", endName(report, leg.heading == Heading::caecum)},
                         {"way_on_central", leg.quality.way_on_central},
                         {"wall_close", leg.quality.wall_close},
                         {"turn_median_deg_mm", leg.quality.turn_median_deg_mm},
                         {"turn_slow_deg_mm", leg.quality.turn_slow_deg_mm},
                         {"roll_median_deg_mm", leg.quality.roll_median_deg_mm}});
    return {{"length_mm", report.length_mm},
            {"views", views},
            {"cells", report.cells},
            {"triangles", report.triangles},
            {"coverage", report.coverage},
            {"reviewed", report.reviewed},
            {"seen_mm2", report.seen_mm2},
            {"whole_mm2", report.whole_mm2},
            {"unseen", toJson(report.unseen, report.parts)},
            {"average_cells", report.average_cells},
            {"average_triangles", report.average_triangles},
            {"average_triangles_seen", report.average_seen},
            {"median_seconds", report.median_seconds},
            {"slow_seconds", report.slow_seconds},
            {"frames", frames}};
}

FlightReport fly(const PreparedScan& scan, const FlightRequest& request, Progress& progress)
{
    FlightRenderer renderer(scan, completed(request));
    const std::vector<Leg> legs = legsOf(scan, request);
    FlightReport report;
    report.length_mm = scan.frames().length_mm();
    report.tree = !scan.tree().empty();
    report.views = qualityOf(legs, scan, renderer.lens());
    report.cells = renderer.scene.cellCount();
    report.triangles = renderer.scene.triangleCount();
    std::size_t all = 0;
    for (const Leg& leg : legs)
        all += leg.poses.size();
    const bool write = request.write_frames && !request.out.empty();
    for (const Leg& leg : legs)
        for (std::size_t n = 0; n < leg.poses.size(); ++n) {
            progress.check();
            const VisibleParts shown = renderer.visibleFrom(leg.poses[n]);
            if (n + 1 < leg.poses.size())
                renderer.prepare(leg.poses[n + 1]);
            const auto png = write ? request.out / frameName(report.frames.size() + 1) : std::filesystem::path{};
            report.frames.push_back(renderer.shoot(leg.poses[n], shown, leg.heading, png));
            progress.report(double(report.frames.size()) / double(all), "flying");
        }
    if (renderer.request.measure_coverage)
        addCoverage(report, renderer);
    summarise(report);
    if (!request.out.empty())
        replaceFile(request.out / "flight.json", toJson(report).dump(1) + "\n");
    return report;
}

}  // namespace vicon::viewer

#include "vicon/viewer/scene/flight.h"

#include <algorithm>
#include <cstdio>

#include "../command.h"
#include "../progress_line.h"
#include "../wall_look_options.h"
#include "vicon/cases/placing.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct FlyArguments {
    std::string case_id, scan_id, out;
    WallLookArguments wall;
    int branch = -1;
    viewer::FlightRequest request;
};

constexpr std::size_t kMostListed = 10;

void printNotShown(const viewer::FlightReport& report, double least_mm2)
{
    if (report.whole_mm2 <= 0)
        return;
    std::printf("not shown: %.0f of %.0f mm2; regions of %g mm2 and more: %zu\n", report.whole_mm2 - report.seen_mm2,
                report.whole_mm2, least_mm2, report.unseen.size());
    for (std::size_t n = 0; n < std::min(report.unseen.size(), kMostListed); ++n) {
        const viewer::UnseenPatch& patch = report.unseen[n];
        const std::string segment = partNameAt(report.parts, patch.station_mm);
        std::printf("  %6.0f mm2 at station %.0f mm%s%s, LPS %.1f %.1f %.1f mm\n", patch.area_mm2, patch.station_mm,
                    segment.empty() ? "" : ", ", segment.c_str(), patch.centre_mm.x, patch.centre_mm.y,
                    patch.centre_mm.z);
    }
    if (report.unseen.size() > kMostListed)
        std::printf("  ... (all with --json or in flight.json)\n");
}

void printViews(const viewer::FlightReport& report)
{
    constexpr double kUsualSpeed_mm_s = 30;
    for (const viewer::FlightLegQuality& leg : report.views) {
        const viewer::FlightQuality& q = leg.quality;
        std::printf(
            "towards the %s: way on in the middle half of %.1f %% of the frames, wall in the middle within a "
            "radius of %.1f %%",
            leg.heading == viewer::Heading::caecum ? "caecum" : "rectum", q.way_on_central * 100, q.wall_close * 100);
        if (q.turn_slow_deg_mm > 0)
            std::printf("; at %.0f mm/s the view turns %.1f deg/s (median), %.1f (99 %%)", kUsualSpeed_mm_s,
                        q.turn_median_deg_mm * kUsualSpeed_mm_s, q.turn_slow_deg_mm * kUsualSpeed_mm_s);
        std::printf("\n");
    }
}

int fly(Context& context, const FlyArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const CaseRecord record = store.requireCase(arguments.case_id);
    const ScanRecord scan = requirePreparedScan(store, record.id, arguments.scan_id);
    viewer::FlightRequest request = arguments.request;
    request.wall = arguments.wall.look();
    request.out = arguments.out;
    request.write_frames = !arguments.out.empty();
    request.caption = viewer::captionFor(record, scan);
    for (Marker& marker : store.markers(record.id))
        if (marker.scan_id == scan.id)
            request.markers.push_back(std::move(marker));
    const auto prepared = viewer::PreparedScan::open(store.scanFolder(record.id, scan.id), arguments.branch);
    ProgressLine progress("fly");
    const viewer::FlightReport report = viewer::fly(prepared, request, progress);
    progress.clear();
    if (context.json) {
        std::printf("%s\n", toJson(report).dump(2).c_str());
        return 0;
    }
    std::printf("%zu frames over %.0f mm", report.frames.size(), report.length_mm);
    if (request.measure_coverage)
        std::printf("; %.1f %% of the wall shown, %.1f %% reviewed", report.coverage * 100, report.reviewed * 100);
    std::printf("\n");
    std::printf("cells drawn %.1f of %zu, triangles drawn %.0f of %zu on average", report.average_cells, report.cells,
                report.average_triangles, report.triangles);
    if (report.median_seconds > 0)
        std::printf("; frame %.1f ms median", report.median_seconds * 1e3);
    std::printf("\n");
    printViews(report);
    printNotShown(report, request.least_unseen_mm2);
    if (!arguments.out.empty())
        std::printf("%s\n", arguments.out.c_str());
    return 0;
}

}  // namespace

Subcommand flyCommand()
{
    return {
        "fly", "Fly through a scan along its centreline: frames, poses, coverage and figures",
        [](CommandLine& command) {
            auto arguments = std::make_shared<FlyArguments>();
            viewer::FlightRequest& request = arguments->request;
            command.option("CASE", arguments->case_id, "The case's id").required();
            command.option("--scan", arguments->scan_id, "The scan (default: the first prepared one)").typeName("SCAN");
            command.option("--to", request.direction, "Where to: caecum (of a tree: tip), rectum (root) or both")
                .captureDefault();
            command
                .option("--branch", arguments->branch,
                        "Of an organ that branches: fly from its root to the end of this branch (default: to the "
                        "farthest tip)")
                .check(range(0, 65535));
            command.option("--step", request.step_mm, "Distance between frames, mm")
                .check(range(0.1, 1000.0))
                .captureDefault();
            command.option("--frames", request.frames, "Number of frames in each direction, instead of --step")
                .check(range(2, 100000));
            command.option("--width", request.width, "Pixels of a frame").check(range(200, 4096));
            command.option("--height", request.height, "Pixels of a frame").check(range(200, 4096));
            command.option("--angle", request.view_angle_deg, "Field of view, degrees")
                .check(range(20.0, 150.0))
                .captureDefault();
            arguments->wall.addTo(command);
            command.flag("!--no-coverage", request.measure_coverage,
                         "Do not measure what of the wall is shown (faster)");
            command
                .option("--unseen", request.least_unseen_mm2,
                        "Least area of a region that was not shown to be listed, mm2")
                .check(range(0.0, 1e6))
                .captureDefault();
            command.flag("!--no-culling", request.cull, "Draw every cell in every frame");
            command.option("--out", arguments->out, "Folder for the frames and flight.json").typeName("DIR");
            return [arguments](Context& context) { return fly(context, *arguments); };
        }};
}

}  // namespace vicon::app

#include "vicon/viewer/scene/snapshot.h"

#include <cstdio>

#include "../command.h"
#include "../priors.h"
#include "../wall_look_options.h"
#include "vicon/cases/placing.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct SnapshotArguments {
    std::string case_id, scan_id, marker, out;
    viewer::SnapshotView view = viewer::SnapshotView::endo;
    double station_mm = 0;
    bool at_station = false;
    int width = 0, height = 0;
    double angle_deg = 90;
    WallLookArguments wall;
    std::string window;
    bool cleansed = false, from_caecum = false;
    std::string peel;
    double peel_offset_mm = 0;
    bool peel_middle = false, peel_over = false;
    bool priors = false;
    int branch = -1;
};

int snapshot(Context& context, const SnapshotArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const CaseRecord record = store.requireCase(arguments.case_id);
    viewer::SnapshotRequest request;
    request.view = arguments.view;
    std::string scan_id = arguments.scan_id;
    if (!arguments.marker.empty()) {
        const Marker marker = store.requireMarker(record.id, arguments.marker);
        if (!scan_id.empty() && !marker.scan_id.starts_with(scan_id))
            throw Error(ErrorCode::wrong_use, "the marker belongs to scan " + marker.scan_id, arguments.marker);
        scan_id = marker.scan_id;
        request.look_at_mm = marker.position_mm;
        request.station_mm = marker.station_mm;
    }
    const ScanRecord scan = requirePreparedScan(store, record.id, scan_id);
    if (arguments.at_station)
        request.station_mm = arguments.station_mm;
    for (Marker& marker : store.markers(record.id))
        if (marker.scan_id == scan.id)
            request.markers.push_back(std::move(marker));
    request.caption = viewer::captionFor(record, scan);
    request.width = arguments.width;
    request.height = arguments.height;
    request.view_angle_deg = arguments.angle_deg;
    request.wall = arguments.wall.look();
    request.window = arguments.window;
    request.cleansed = arguments.cleansed;
    request.from_caecum = arguments.from_caecum;
    request.whole_band = !arguments.at_station && arguments.marker.empty();
    request.peel.preset = arguments.peel;
    request.peel.options.offset_mm = arguments.peel_offset_mm;
    request.peel.middle_only = arguments.peel_middle;
    request.peel.over_surface = arguments.peel_over;
    const auto prepared = viewer::PreparedScan::open(store.scanFolder(record.id, scan.id), arguments.branch);
    for (const ScanColon& colon : arguments.priors ? colonsOf(store, record.id) : std::vector<ScanColon>{})
        if (colon.scan_id == scan.id)
            request.priors = viewer::priorPlacesIn(priorsOf(store, record.id), colon, prepared.skeleton(),
                                                   context.config().get<PriorOptions>());
    const auto result = viewer::renderSnapshot(prepared, request, arguments.out);
    if (!result.sees_target)
        std::fprintf(
            stderr,
            "vicon: no place inside the lumen has the marker in plain view; the picture looks from the nearest one\n");
    std::printf("%s\n", arguments.out.c_str());
    return 0;
}

std::string peelingPresets()
{
    std::string names;
    for (const viewer::TransferFunction& function : viewer::transferFunctions())
        names += (names.empty() ? "" : ", ") + function.name;
    return names;
}

}  // namespace

Subcommand snapshotCommand()
{
    return {
        "snapshot", "Write a picture of a scan to a PNG file, without a window", [](CommandLine& command) {
            auto arguments = std::make_shared<SnapshotArguments>();
            command.option("CASE", arguments->case_id, "The case's id").required();
            command
                .option("--branch", arguments->branch,
                        "Of an organ that branches: stations on the way to the end of this branch (default: to the "
                        "farthest tip)")
                .check(range(0, 65535));
            command
                .option("--scan", arguments->scan_id, "The scan (default: the marker's, else the first prepared one)")
                .typeName("SCAN");
            command
                .option("--view", arguments->view,
                        "endo (from inside), slices (three planes), overview (whole colon), cube (all around the eye) "
                        "or band (whole colon cut open)")
                .required();
            const auto marker = command.option("--marker", arguments->marker, "Look at this marker").typeName("ID");
            const auto station =
                command
                    .option("--station", arguments->station_mm, "Look along the colon at this distance from the rectum")
                    .typeName("MM")
                    .excludes(marker);
            command.option("--out", arguments->out, "The PNG file").required().typeName("FILE");
            command.option("--width", arguments->width, "Pixels").check(range(200, 4096));
            command.option("--height", arguments->height, "Pixels").check(range(200, 4096));
            command.option("--angle", arguments->angle_deg, "Field of view of the endoscopic view, degrees")
                .check(range(20.0, 150.0))
                .captureDefault();
            arguments->wall.addTo(command);
            command.flag("--as-acquired", arguments->wall.wall.acquired,
                         "Endo and cube: the wall by the acquired densities, tagged fluid and stool standing");
            command.option("--window", arguments->window, "Window/level preset of the slices (default: the organ's)");
            command.flag("--priors", arguments->priors,
                         "Slices and overview: where findings of earlier reports should lie");
            command.flag("--cleansed", arguments->cleansed, "Slices without tagging, where that was taken out");
            command.flag("--from-caecum", arguments->from_caecum, "The band begins at the caecum");
            const auto peel =
                command
                    .option("--peel", arguments->peel,
                            "Endoscopic view: look below the wall, with this preset (" + peelingPresets() + ")")
                    .typeName("PRESET");
            command
                .option("--peel-offset", arguments->peel_offset_mm,
                        "How far below the surface the look begins, mm; below 0: before it")
                .check(range(-20.0, 20.0))
                .needs(peel)
                .captureDefault();
            command.flag("--peel-middle", arguments->peel_middle, "Translucent only in a circle in the middle")
                .needs(peel);
            command.flag("--peel-over", arguments->peel_over, "Lay it over the surface instead of in its place")
                .needs(peel);
            return [arguments, station](Context& context) {
                arguments->at_station = station.given();
                return snapshot(context, *arguments);
            };
        }};
}

}  // namespace vicon::app

#include "vicon/viewer/scene/snapshot.h"

#include <cstdio>

#include "../command.h"
#include "vicon/cases/placing.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct SnapshotArguments {
    std::string case_id, scan_id, view, marker, out;
    double station_mm = 0;
    bool at_station = false;
    int width = 0, height = 0;
    double angle_deg = 90;
    bool ambient_occlusion = false;
    std::string window;
    std::string peel;
    double peel_offset_mm = 0;
    bool peel_middle = false;
    int branch = -1;
};

int snapshot(Context& context, const SnapshotArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const CaseRecord record = store.requireCase(arguments.case_id);
    viewer::SnapshotRequest request;
    request.view = viewer::snapshotViewFrom(arguments.view);
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
    request.ambient_occlusion = arguments.ambient_occlusion;
    request.window = arguments.window;
    request.peel = arguments.peel;
    request.peeling.offset_mm = arguments.peel_offset_mm;
    request.peel_middle_only = arguments.peel_middle;
    const auto prepared = viewer::PreparedScan::open(store.scanFolder(record.id, scan.id), arguments.branch);
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
        "snapshot", "Write a picture of a scan to a PNG file, without a window", [](CLI::App& command) {
            auto arguments = std::make_shared<SnapshotArguments>();
            command.add_option("CASE", arguments->case_id, "The case's id")->required();
            command
                .add_option("--branch", arguments->branch,
                            "Of an organ that branches: stations on the way to the end of this branch (default: to the "
                            "farthest tip)")
                ->check(CLI::Range(0, 65535));
            command
                .add_option("--scan", arguments->scan_id,
                            "The scan (default: the marker's, else the first prepared one)")
                ->type_name("SCAN");
            command
                .add_option("--view", arguments->view,
                            "endo (from inside), slices (three planes) or overview (whole colon)")
                ->required();
            auto* marker = command.add_option("--marker", arguments->marker, "Look at this marker")->type_name("ID");
            auto* station = command
                                .add_option("--station", arguments->station_mm,
                                            "Look along the colon at this distance from the rectum")
                                ->type_name("MM")
                                ->excludes(marker);
            command.add_option("--out", arguments->out, "The PNG file")->required()->type_name("FILE");
            command.add_option("--width", arguments->width, "Pixels")->check(CLI::Range(200, 4096));
            command.add_option("--height", arguments->height, "Pixels")->check(CLI::Range(200, 4096));
            command.add_option("--angle", arguments->angle_deg, "Viewing angle of the endoscopic view, degrees")
                ->check(CLI::Range(20, 150))
                ->capture_default_str();
            command.add_flag("--ambient-occlusion", arguments->ambient_occlusion,
                             "Endoscopic view: less light between folds and at the foot of what rises from the wall");
            command.add_option("--window", arguments->window,
                               "Window/level preset of the slices (default: the organ's)");
            auto* peel =
                command
                    .add_option("--peel", arguments->peel,
                                "Endoscopic view: look below the wall, with this preset (" + peelingPresets() + ")")
                    ->type_name("PRESET");
            command
                .add_option("--peel-offset", arguments->peel_offset_mm, "How far below the surface the look begins, mm")
                ->check(CLI::Range(0, 20))
                ->needs(peel)
                ->capture_default_str();
            command.add_flag("--peel-middle", arguments->peel_middle, "Peel only a circle in the middle")->needs(peel);
            return [arguments, station](Context& context) {
                arguments->at_station = station->count() > 0;
                return snapshot(context, *arguments);
            };
        }};
}

}  // namespace vicon::app

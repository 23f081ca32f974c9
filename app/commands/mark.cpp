#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

#include "../command.h"
#include "../point_argument.h"
#include "../progress_line.h"
#include "../text_table.h"
#include "vicon/cases/finding_facts.h"
#include "vicon/cases/pair_proposals.h"
#include "vicon/cases/placing.h"
#include "vicon/cases/whole_id.h"
#include "vicon/core/error.h"

namespace vicon::app {
namespace {

struct MarkArguments {
    std::string case_id, scan_id, at, color = "red", note;
    double biopsy_mm = 0;  // 0: none
    bool outline = false;
};

void printMarkers(const std::vector<Marker>& markers)
{
    std::vector<std::vector<std::string>> rows;
    for (const Marker& m : markers)
        rows.push_back({m.id, m.scan_id, nameOf(m.color),
                        formatNumber(m.position_mm.x, 1) + ", " + formatNumber(m.position_mm.y, 1) + ", " +
                            formatNumber(m.position_mm.z, 1),
                        formatNumber(m.station_mm, 0), formatNumber(m.from_caecum_mm, 0),
                        formatNumber(m.fraction * 100, 0) + " %", m.part ? nameOf(*m.part) : "-",
                        m.size ? formatNumber(largestDiameter_mm(*m.size), 1) : "-", m.note});
    std::printf("%s", formatTable({"ID", "SCAN", "COLOR", "LPS MM", "FROM RECTUM MM", "FROM CAECUM MM", "FRACTION",
                                   "SEGMENT", "SIZE MM", "NOTE"},
                                  rows)
                          .c_str());
}

/// A copy that could not be written is not a change that failed.
void tellOfCopy(const CaseStore& store)
{
    if (!store.markerFileTrouble().empty())
        std::fprintf(stderr, "vicon: saved in the database; markers.json will be written later: %s\n",
                     store.markerFileTrouble().c_str());
}

int mark(Context& context, const MarkArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const std::string case_id = requireCase(store, arguments.case_id, IdPart::whole).id;
    Marker marker;
    marker.scan_id = arguments.scan_id;
    marker.position_mm = pointFrom(arguments.at, "--at");
    marker.color = markerColorFrom(arguments.color);
    marker.note = arguments.note;
    marker = placeMarker(store, context.config().get<MarkOptions>(), case_id, marker);
    if (arguments.biopsy_mm > 0)
        addDensity(store, case_id, marker, arguments.biopsy_mm);
    if (arguments.outline)
        addPolypSize(store, case_id, marker);
    marker = store.saveMarker(case_id, marker);
    tellOfCopy(store);
    if (context.json)
        std::printf("%s\n", toJson(marker).dump(2).c_str());
    else
        printMarkers({marker});
    return 0;
}

struct MarkersArguments {
    std::string case_id, remove, change, color, note, at, import_file, export_file;
    bool change_note = false;

    bool changes() const { return !(import_file + change + remove).empty(); }
};

/// All or nothing. An id that the case has is replaced.
void importMarkers(CaseStore& store, const MarkOptions& options, const std::string& case_id, const std::string& file)
{
    ProgressLine progress("markers");
    const std::vector<MarkerEdit> edits = importOf(store, options, case_id, file, progress);
    progress.clear();
    store.editMarkers(case_id, edits);
}

void changeMarker(CaseStore& store, const MarkOptions& options, const std::string& case_id,
                  const MarkersArguments& arguments)
{
    const Marker before = store.requireMarker(case_id, arguments.change);
    Marker marker = before;
    if (!arguments.color.empty())
        marker.color = markerColorFrom(arguments.color);
    if (arguments.change_note)
        marker.note = arguments.note;
    if (!arguments.at.empty()) {
        marker.position_mm = pointFrom(arguments.at, "--at");
        marker = placeMarker(store, options, case_id, std::move(marker));
    }
    store.editMarkers(case_id, {{before, marker}});
}

int markers(Context& context, const MarkersArguments& arguments)
{
    CaseStore& store = context.existingStore();
    const IdPart enough = arguments.changes() ? IdPart::whole : IdPart::beginning;
    const std::string case_id = requireCase(store, arguments.case_id, enough).id;
    const auto options = context.config().get<MarkOptions>();
    if (!arguments.import_file.empty())
        importMarkers(store, options, case_id, arguments.import_file);
    if (!arguments.change.empty())
        changeMarker(store, options, case_id, arguments);
    if (!arguments.remove.empty())
        store.removeMarker(case_id, arguments.remove);
    tellOfCopy(store);
    const auto list = store.markers(case_id);
    if (!arguments.export_file.empty())
        writeMarkers(arguments.export_file, list);
    if (context.json)
        std::printf("%s\n", toJson(list).dump(2).c_str());
    else if (list.empty())
        std::printf("no markers; 'vicon mark %s --at X,Y,Z' adds one\n", case_id.c_str());
    else
        printMarkers(list);
    if (!context.json && mayBePaired(list) && !proposePairs(list, matchesOf(store, case_id)).empty())
        std::printf("some of them may be one finding; 'vicon match %s' proposes pairs\n", case_id.c_str());
    return 0;
}

}  // namespace

Subcommand markCommand()
{
    return {"mark", "Add a marker at a point of the colon", [](CommandLine& command) {
                auto arguments = std::make_shared<MarkArguments>();
                command.option("CASE", arguments->case_id, "The case's whole id").required();
                command
                    .option("--scan", arguments->scan_id,
                            "The scan; needed where the point lies in the lumen of several")
                    .typeName("SCAN");
                command.option("--at", arguments->at, "Position in LPS mm").required().typeName("X,Y,Z");
                command.option("--color", arguments->color, "red, yellow or green").captureDefault();
                command.option("--note", arguments->note, "What is seen there").typeName("TEXT").mayBeEmpty();
                command
                    .option("--biopsy", arguments->biopsy_mm,
                            "Keep mean density and histogram of the tissue within this many mm of the point")
                    .typeName("MM")
                    .check(range(0.5, 25.0));
                command.flag("--outline", arguments->outline,
                             "Outline the polyp under the point, and keep its size with the marker");
                return [arguments](Context& context) { return mark(context, *arguments); };
            }};
}

Subcommand markersCommand()
{
    return {
        "markers", "List, change, remove, import or export the markers of a case", [](CommandLine& command) {
            auto arguments = std::make_shared<MarkersArguments>();
            command.option("CASE", arguments->case_id, "The case's id, whole to change something").required();
            command.option("--remove", arguments->remove, "Remove this marker").typeName("ID");
            const auto change = command.option("--change", arguments->change, "Change this marker").typeName("ID");
            command.option("--color", arguments->color, "Its new color").needs(change);
            const auto note =
                command.option("--note", arguments->note, "Its new note").needs(change).typeName("TEXT").mayBeEmpty();
            command.option("--at", arguments->at, "Its new position in LPS mm").needs(change).typeName("X,Y,Z");
            command.option("--import", arguments->import_file, "Add the markers of a JSON file").typeName("FILE");
            command.option("--export", arguments->export_file, "Write all markers to a JSON file").typeName("FILE");
            return [arguments, note](Context& context) {
                arguments->change_note = note.given();
                return markers(context, *arguments);
            };
        }};
}

}  // namespace vicon::app

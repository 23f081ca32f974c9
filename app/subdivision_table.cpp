#include "subdivision_table.h"

#include <cstdio>
#include <vector>

#include "progress_line.h"
#include "text_table.h"
#include "vicon/core/quantity.h"
#include "vicon/pipeline/subdivision_table.h"

namespace vicon::app {
namespace {

std::vector<std::string> cellsOf(const std::string& scan, const pipeline::SubdivisionRow& row)
{
    const auto number = [&](const char* key, int decimals) {
        return formatNumber(row.statistics.value(key, 0.0), decimals);
    };
    const auto cost = [&](const char* key) { return row.statistics.contains(key) ? number(key, 2) : std::string("-"); };
    const bool thesis = row.options.method == SubdivideMethod::thesis;
    return {scan,
            nameIn(kSubdivideMethodNames, row.options.method),
            thesis ? nameIn(steps::kSegmentSizeNames, row.options.size) : "-",
            thesis ? nameIn(steps::kPortalEffectivenessNames, row.options.effectiveness) : "-",
            number("segments", 0) + " / " + number("specified_segments", 0),
            number("triangles_average", 0),
            number("triangles_largest", 0) + " / " + number("triangles_smallest", 0),
            number("triangles_standard_deviation", 2),
            cost("choice_cost"),
            cost("choice_cost_at_least"),
            cost("choice_cost_neighbours_only")};
}

}  // namespace

int printSubdivisionTable(CaseStore& store, const Config& config, const WorklistCase& of, const std::string& scan_id)
{
    std::vector<std::vector<std::string>> rows;
    for (const WorklistScan& scan : of.scans) {
        const auto folder = store.scanFolder(of.record.id, scan.record.id);
        if (!scan.record.id.starts_with(scan_id) || !std::filesystem::exists(folder / "subdivision.json"))
            continue;
        ProgressLine progress("scan " + scan.record.id);
        for (const pipeline::SubdivisionRow& row :
             pipeline::subdivisionTable(folder, config, quantityOf(scan.record.series), progress))
            rows.push_back(cellsOf(scan.record.id, row));
    }
    std::printf("%s",
                formatTable({"SCAN", "METHOD", "SIZE BY", "PORTALS BY", "SEGMENTS / SPECIFIED", "AVERAGE TRIANGLES",
                             "LARGEST / SMALLEST", "STANDARD DEVIATION", "COST", "LEAST COST", "NEIGHBOURS ONLY"},
                            rows)
                    .c_str());
    return 0;
}

}  // namespace vicon::app

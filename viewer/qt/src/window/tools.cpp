#include "window/tools.h"

#include "biopsy/biopsy_tool.h"
#include "branches/branch_tool.h"
#include "comparison/comparison_tool.h"
#include "corrections/correction_tool.h"
#include "coverage/coverage_tool.h"
#include "film/film_tool.h"
#include "flight/flight_tool.h"
#include "looks/look_tool.h"
#include "markers/marker_tool.h"
#include "measuring/measuring_tool.h"
#include "opening/opening_tool.h"
#include "peeling/peeling_tool.h"
#include "pictures/picture_tool.h"
#include "report/report_tool.h"
#include "slices/slice_tool.h"

namespace vicon::viewer {

ReadingTools makeReadingTools(Reading& reading, const ReadingServices& services, const WorklistCase& case_row)
{
    ReadingTools tools;
    const auto add = [&](auto tool) {
        auto* added = tool.get();
        tools.all.push_back(std::move(tool));
        return added;
    };
    // A line each. Their order is that of lists, panels and menu entries; the place in a scan comes before what is
    // shown there.
    tools.opening = add(std::make_unique<OpeningTool>(reading));
    add(std::make_unique<BranchTool>(reading));
    add(std::make_unique<SliceTool>(reading));
    add(std::make_unique<FlightTool>(reading));
    add(std::make_unique<PictureTool>(reading));
    add(std::make_unique<FilmTool>(reading));
    add(std::make_unique<MarkerTool>(reading));
    add(std::make_unique<ReportTool>(reading, services, case_row.record.id));
    add(std::make_unique<MeasuringTool>(reading));
    const auto* peeling = add(std::make_unique<PeelingTool>(reading));
    add(std::make_unique<BiopsyTool>(reading, peeling->panel()));
    add(std::make_unique<CoverageTool>(reading));
    add(std::make_unique<CorrectionTool>(reading, services, case_row.record.id));
    add(std::make_unique<ComparisonTool>(reading));
    add(std::make_unique<LookTool>(reading));
    return tools;
}

}  // namespace vicon::viewer

#include "window/tools.h"

#include "banner/banner_tool.h"
#include "biopsy/biopsy_tool.h"
#include "branches/branch_tool.h"
#include "comparison/comparison_tool.h"
#include "comparison/pair_tool.h"
#include "corrections/correction_tool.h"
#include "coverage/coverage_tool.h"
#include "film/film_tool.h"
#include "flight/flight_tool.h"
#include "guide/guide_tool.h"
#include "hanging/hanging_tool.h"
#include "looks/look_tool.h"
#include "markers/marker_tool.h"
#include "measuring/measuring_tool.h"
#include "opening/opening_tool.h"
#include "panorama/panorama_tool.h"
#include "peeling/peeling_tool.h"
#include "pictures/picture_tool.h"
#include "priors/prior_tool.h"
#include "reading_time/reading_time_tool.h"
#include "report/report_tool.h"
#include "slices/slice_tool.h"
#include "turning/turning_tool.h"

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
    add(std::make_unique<BannerTool>(reading));
    add(std::make_unique<BranchTool>(reading));
    auto* slices = add(std::make_unique<SliceTool>(reading));
    add(std::make_unique<HangingTool>(reading, *slices));
    add(std::make_unique<FlightTool>(reading));
    add(std::make_unique<PictureTool>(reading));
    add(std::make_unique<FilmTool>(reading));
    add(std::make_unique<MarkerTool>(reading));
    add(std::make_unique<MeasuringTool>(reading));
    const auto* peeling = add(std::make_unique<PeelingTool>(reading));
    add(std::make_unique<BiopsyTool>(reading, peeling->panel()));
    auto* coverage = add(std::make_unique<CoverageTool>(reading));
    const auto* time = add(std::make_unique<ReadingTimeTool>(reading, *coverage));
    add(std::make_unique<ReportTool>(reading, services, case_row.record.id, *coverage, *time));
    add(std::make_unique<CorrectionTool>(reading, services, case_row.record.id));
    add(std::make_unique<ComparisonTool>(reading));
    add(std::make_unique<PriorTool>(reading, services, case_row.record.id));
    add(std::make_unique<PairTool>(reading, services, case_row.record.id));
    add(std::make_unique<LookTool>(reading));
    add(std::make_unique<PanoramaTool>(reading));
    add(std::make_unique<TurningTool>(reading));
    add(std::make_unique<GuideTool>(reading));
    return tools;
}

}  // namespace vicon::viewer

#include "tissue_step.h"

#include "step_parameters.h"
#include "vicon/cases/step_results.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/tissue.h"

using nlohmann::json;

namespace vicon::pipeline {
namespace {

constexpr const char* kNoTagging = "none: MR";  // nothing is cleansed then

}  // namespace

bool wallFromTissue(const Config& config)
{
    return isColon(config) && config.get<steps::WallOptions>().wall == steps::WallSource::tissue;
}

std::shared_future<steps::LumenSurface> surfaceOf(const Config& config, ScanResults& results)
{
    return wallFromTissue(config) ? results.surface() : results.surface(config.get<steps::WallDensities>());
}

json tissueParameters(const Config& config)
{
    return wallFromTissue(config)
               ? parametersFrom<steps::WallOptions, steps::WallDensities, steps::TissueOptions>(config)
               : parametersFrom<steps::WallOptions>(config);
}

json runTissue(const StepInputs& inputs, ScanResults& results, const StepRecords& records, Progress& progress)
{
    if (!wallFromTissue(inputs.config)) {
        results.put(InsideVolume(results.mask()));
        results.dropMask();
        return toJson(TissueFound{.not_sought = "the wall is not taken from it"});
    }
    const SegmentFound segment = segmentFoundFromJson(records.at("segment").result);
    auto options = inputs.config.get<steps::TissueOptions>();
    options.leave_out_other_bowel = !segment.given;
    options.find_stool = inputs.quantity == Quantity::density;
    steps::TissueResult found = steps::findTissue(
        results.densitiesAroundLumen(), results.mask(), inputs.gravity, inputs.config.get<steps::WallDensities>(),
        segment.usualNoise_hu().value_or(0), progress, options, inputs.config.get<steps::SegmentOptions>().cut);
    results.dropMask();
    TissueFound told{
        .blur_mm = found.blur_mm, .untrusted = std::move(found.untrusted), .measures = std::move(found.found)};
    if (inputs.quantity == Quantity::density) {
        results.write("cleansed.mha", std::move(found.cleansed));
    } else {
        told.untrusted.mottled = {};
        told.measures["tagging"] = kNoTagging;
    }
    results.put(std::move(found.lumen));
    results.putTissue(std::move(found.tissue));
    return toJson(told);
}

std::vector<std::string> tissueFiles(const json& result)
{
    const TissueFound found = tissueFoundFromJson(result);
    if (!found.not_sought.empty())
        return {"inside.mha"};
    if (found.measures.contains("tagging"))
        return {"inside.mha", "tissue.mha"};
    return {"inside.mha", "tissue.mha", "cleansed.mha"};
}

}  // namespace vicon::pipeline

#include "skeleton_step.h"

#include <future>

#include "step_parameters.h"
#include "tissue_step.h"
#include "vicon/cases/step_results.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/subdivide.h"

using nlohmann::json;

namespace vicon::pipeline {
namespace {

/// The skeleton of an organ that branches.
json runTree(const steps::LumenPlan& plan, const StepInputs& inputs, ScanResults& results, Progress& progress)
{
    steps::TreeResult found = steps::findTree(results.inside(), plan.pieces.at(0).rectal_end_mm,
                                              inputs.config.get<steps::OrganOptions>().branch_mm,
                                              inputs.config.get<steps::SkeletonOptions>(), progress);
    const std::vector<int> tips = found.tree.tips();
    const SkeletonFound result{found.tree.pathTo(tips.front()).length_mm(),
                               {{"branches", found.tree.branches.size()},
                                {"tips", tips.size()},
                                {"total_length_mm", found.tree.totalLength_mm()}}};
    scan_files::writeSkeletonVoxels(results.target("skeleton_voxels.vtp"), found.voxels);
    scan_files::writeSkeletonTree(results.target("skeleton.vtp"), found.tree);
    return toJson(result);
}

constexpr const char* kNoPath = "no_path";  // a measure of a cavity's

/// A cavity has none, and its file says so.
json runNoSkeleton(const steps::LumenPlan& plan, ScanResults& results)
{
    const steps::LumenPiece& cavity = plan.pieces.at(0);
    scan_files::writeNoPath(results.target("skeleton.vtp"), {cavity.rectal_end_mm, 0, cavity.max_radius_mm});
    return toJson(SkeletonFound{0, {{kNoPath, true}}});
}

}  // namespace

json runSkeleton(const StepInputs& inputs, ScanResults& results, const StepRecords& records, Progress& progress)
{
    const steps::LumenPlan plan = steps::lumenPlanFromJson(records.at("segment").result.at("plan"));
    if (!hasPath(inputs.config))
        return runNoSkeleton(plan, results);
    if (!isColon(inputs.config))
        return runTree(plan, inputs, results, progress);
    // Two thirds of dividing the lumen need no curve, distances from the wall none at all, and cores are free here.
    const steps::SkeletonHooks hooks{
        .core_free =
            [&] {
                if (!wallFromTissue(inputs.config))
                    results.beginSurface(inputs.config.get<steps::WallDensities>());
                results.beginWallDistance();
            },
        .paths_found =
            [&](const std::vector<std::vector<Index3>>& paths) {
                if (inputs.config.get<steps::SubdivideOptions>().method == SubdivideMethod::flood)
                    results.keepFlood(std::async(std::launch::async, [&inside = results.inside(), paths] {
                        return steps::floodFromPaths(inside, paths);
                    }));
            }};
    steps::SkeletonResult found =
        steps::findSkeleton(results.inside(), plan, inputs.config.get<steps::SkeletonOptions>(), progress, hooks);
    const SkeletonFound result{found.curve.length_mm(), found.measures};
    scan_files::writeSkeletonVoxels(results.target("skeleton_voxels.vtp"), found.voxels);
    results.put(std::move(found.curve));
    return toJson(result);
}

std::vector<std::string> skeletonFiles(const json& result)
{
    if (result.contains(kNoPath))
        return {"skeleton.vtp"};
    return {"skeleton.vtp", "skeleton_voxels.vtp"};
}

}  // namespace vicon::pipeline

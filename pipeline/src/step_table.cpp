#include "step_table.h"

#include <algorithm>
#include <functional>
#include <future>
#include <iterator>
#include <optional>

#include "part_of_progress.h"
#include "segment_step.h"
#include "skeleton_step.h"
#include "step_parameters.h"
#include "tissue_step.h"
#include "vicon/cases/step_results.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/projections_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/colon_parts.h"
#include "vicon/steps/exit_distance.h"
#include "vicon/steps/largest.h"
#include "vicon/steps/lumen_contrast.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/projections.h"
#include "vicon/steps/quality.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/tissue.h"
#include "vicon/steps/wall_distance.h"

using nlohmann::json;

namespace vicon::pipeline {
namespace {

std::function<std::vector<std::string>(const json&)> always(std::vector<std::string> files)
{
    return [files = std::move(files)](const json&) { return files; };
}

json runResample(const StepInputs& inputs, ScanResults& results, const StepRecords&, Progress& progress)
{
    PartOfProgress decode(progress, 0, 0.5), rest(progress, 0.5, 1);
    HuVolume acquired = inputs.loader(inputs.dicom_folder, decode);
    ResampleFound found{.acquired_size = acquired.grid.size, .acquired_spacing_mm = acquired.grid.spacing_mm};
    results.put(steps::resample(std::move(acquired), inputs.config.get<steps::ResampleOptions>(), rest));
    found.size = results.volume().grid.size;
    found.spacing_mm = results.volume().grid.spacing_mm[0];
    return toJson(found);
}

json runQuality(const StepInputs& inputs, ScanResults& results, const StepRecords& records, Progress& progress)
{
    if (!isColon(inputs.config))
        return toJson(QualityFound{.not_measured = "segments and quality are those of a colon"});
    const auto options = inputs.config.get<steps::QualityOptions>();
    const steps::FoundParts parts = steps::findColonParts(results.skeleton());
    QualityFound found{.parts = parts.ranges, .parts_unknown = parts.reason};
    if (!results.skeleton().empty())
        found.quality =
            steps::measureQuality(results.inside(), results.skeleton(), parts.ranges,
                                  segmentFoundFromJson(records.at("segment").result).acquiredNoise_hu().value_or(0),
                                  tissueFoundFromJson(records.at("tissue").result).untrusted, options, progress);
    return toJson(found);
}

steps::Subdivided divide(const StepInputs& inputs, ScanResults& results, Progress& progress)
{
    auto options = inputs.config.get<steps::SubdivideOptions>();
    if (!hasPath(inputs.config))
        return steps::undivided(results.inside(), options, progress);
    const SkeletonTree tree = scan_files::readSkeletonTree(results.source("skeleton.vtp"));
    if (!tree.empty())
        options.method = SubdivideMethod::flood;  // planes across one path do not part branches
    return steps::subdivide(results.inside(), tree.empty() ? results.skeleton() : tree.allBranches(),
                            scan_files::readSkeletonVoxels(results.source("skeleton_voxels.vtp")), options, progress,
                            results.takeFlood());
}

json runSubdivide(const StepInputs& inputs, ScanResults& results, const StepRecords&, Progress& progress)
{
    PartOfProgress dividing(progress, 0, 0.6), tell(progress, 0.6, 0.9), project(progress, 0.9, 1);
    const auto contour = surfaceOf(inputs.config, results);
    steps::Subdivided divided = divide(inputs, results, dividing);
    results.put(std::move(divided.segments));
    const CellSurface surface = contour.get().cellsOf(results.segments(), tell);
    steps::countTriangles(surface, divided.description);
    auto cells = std::async(std::launch::async, [&] { scan_files::writeCells(results.target("cells.vtp"), surface); });
    scan_files::writeProjections(results.target("projections"),
                                 steps::project(surface, inputs.config.get<steps::ProjectionOptions>(), project));
    scan_files::writeSubdivision(results.target("subdivision.json"), divided.description);
    cells.get();
    return toJson(SubdivideFound{divided.description.method, surface.triangleCount(), divided.description.statistics});
}

json runPotential(const StepInputs& inputs, ScanResults& results, const StepRecords&, Progress& progress)
{
    PartOfProgress wall(progress, 0, 0.3), exit(progress, 0.3, 1);
    PotentialFound found;
    const std::optional<double> ahead_mm = results.takeLargestWallDistance();
    found.largest_wall_distance_mm =
        ahead_mm ? *ahead_mm
                 : results.putWallDistance(
                       steps::wallDistance(results.inside(), surfaceOf(inputs.config, results).get().nearWall(), wall));
    if (!hasPath(inputs.config))
        return toJson(found);
    const SkeletonTree tree = scan_files::readSkeletonTree(results.source("skeleton.vtp"));
    FieldVolume from_exit_mm = tree.empty() ? steps::exitDistance(results.inside(), results.skeleton(), exit)
                                            : steps::exitDistance(results.inside(), tree, exit);
    found.largest_exit_distance_mm = steps::largestOf(from_exit_mm);
    results.write("exit_distance.mha", std::move(from_exit_mm));
    return toJson(found);
}

std::vector<std::string> potentialFiles(const json& result)
{
    const PotentialFound found = potentialFoundFromJson(result);
    if (found.largest_wall_distance_mm > 0 && !found.largest_exit_distance_mm)
        return {"wall_distance.mha"};
    return {"exit_distance.mha", "wall_distance.mha"};
}

/// What lies where: volume, lumen, tissue, centreline.
std::vector<Step> stepsOfLumen()
{
    using namespace steps;
    return {
        {"resample",
         2,
         0,
         0.3,
         {},
         Densities::whole,
         always({"volume.mha"}),
         parametersFrom<ResampleOptions>,
         runResample},
        {"segment", 17, 0.3, 0.55, {"resample"}, Densities::whole, segmentFiles, segmentParameters, runSegment},
        {"tissue",
         15,
         0.55,
         0.6,
         {"resample", "segment"},
         Densities::around_lumen,
         tissueFiles,
         tissueParameters,
         runTissue},
        {"skeleton",
         14,
         0.6,
         0.65,
         {"segment", "tissue"},
         Densities::around_lumen,
         skeletonFiles,
         parametersByOrgan<SkeletonOptions, SkeletonOptions>,
         runSkeleton},
    };
}

/// What is made of them.
std::vector<Step> stepsOfResults()
{
    using namespace steps;
    return {
        {"quality",
         7,
         0.65,
         0.67,
         {"segment", "tissue", "skeleton"},
         Densities::none,
         always({}),
         parametersFrom<QualityOptions>,
         runQuality},
        {"subdivide",
         5,
         0.67,
         0.85,
         {"resample", "segment", "tissue", "skeleton"},
         Densities::around_lumen,
         always({"segments.mha", "subdivision.json", "cells.vtp", "projections/coronal.png",
                 "projections/transverse.png", "projections/sagittal.png", "projections/projections.json"}),
         parametersFrom<SubdivideOptions, WallOptions, WallDensities, ProjectionOptions>,
         runSubdivide},
        {"potential",
         3,
         0.85,
         1,
         {"resample", "segment", "tissue", "skeleton"},
         Densities::around_lumen,
         potentialFiles,
         parametersFrom<WallOptions, WallDensities>,
         runPotential},
    };
}

}  // namespace

const std::vector<Step>& stepTable()
{
    static const std::vector<Step> kTable = [] {
        std::vector<Step> all = stepsOfLumen();
        const std::vector<Step> rest = stepsOfResults();
        all.insert(all.end(), rest.begin(), rest.end());
        return all;
    }();
    return kTable;
}

std::vector<OptionSpec> stepOptionSpecs()
{
    std::vector<OptionSpec> all;
    // Several steps use the wall's densities; each option is declared once.
    const auto known = [&](const OptionSpec& spec) {
        return std::any_of(all.begin(), all.end(), [&](const OptionSpec& other) { return other.key == spec.key; });
    };
    const auto add = [&](const std::vector<OptionSpec>& specs) {
        std::copy_if(specs.begin(), specs.end(), std::back_inserter(all), std::not_fn(known));
    };
    add(specsOf<StepOptions>());
    add(specsOf<steps::ResampleOptions>());
    add(specsOf<steps::SegmentOptions>());
    add(specsOf<steps::SignalOptions>());
    add(specsOf<steps::OrganOptions>());
    add(specsOf<steps::TissueOptions>());
    add(specsOf<steps::SkeletonOptions>());
    add(specsOf<steps::QualityOptions>());
    add(specsOf<steps::SubdivideOptions>());
    add(specsOf<steps::WallOptions>());
    add(specsOf<steps::ProjectionOptions>());
    return all;
}

}  // namespace vicon::pipeline

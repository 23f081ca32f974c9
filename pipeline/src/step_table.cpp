#include "step_table.h"

#include <algorithm>
#include <functional>
#include <future>
#include <iterator>

#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/projections_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/colon_parts.h"
#include "vicon/steps/exit_distance.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/projections.h"
#include "vicon/steps/quality.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/wall_distance.h"

using nlohmann::json;

namespace vicon::pipeline {
namespace {

/// Parameters of a step from the options structs it uses.
template <class... Options>
json parametersFrom(const Config& config)
{
    json all = json::object();
    (all.update(toJson(config.get<Options>())), ...);
    return all;
}

bool isColon(const Config& config)
{
    return config.get<steps::OrganOptions>().isColon();
}

/// Parameters of a step that other organs go through too; the colon's do not depend on options of other organs.
template <class OfColon, class OfOthers>
json parametersByOrgan(const Config& config)
{
    json all = isColon(config) ? parametersFrom<OfColon>(config) : parametersFrom<OfOthers>(config);
    if (!isColon(config))
        all.update(parametersFrom<steps::OrganOptions>(config));
    return all;
}

std::function<std::vector<std::string>(const json&)> always(std::vector<std::string> files)
{
    return [files = std::move(files)](const json&) { return files; };
}

/// Tells a part of a step's progress as a part of the whole.
class PartOfProgress : public Progress {
public:
    PartOfProgress(Progress& whole, double from, double to) : whole_(whole), from_(from), to_(to) {}
    void report(double fraction, std::string_view what) override
    {
        whole_.report(from_ + (to_ - from_) * fraction, what);
    }
    bool cancelled() const override { return whole_.cancelled(); }

private:
    Progress& whole_;
    double from_, to_;
};

json runResample(const StepInputs& inputs, ScanArtefacts& artefacts, const StepRecords&, Progress& progress)
{
    PartOfProgress decode(progress, 0, 0.5), rest(progress, 0.5, 1);
    HuVolume acquired = inputs.loader(inputs.dicom_folder, decode);
    json result = {{"acquired_size", acquired.grid.size}, {"acquired_spacing_mm", acquired.grid.spacing_mm}};
    artefacts.put(steps::resample(std::move(acquired), inputs.config.get<steps::ResampleOptions>(), rest));
    result["size"] = artefacts.volume().grid.size;
    result["spacing_mm"] = artefacts.volume().grid.spacing_mm[0];
    return result;
}

json runSegment(const StepInputs& inputs, ScanArtefacts& artefacts, const StepRecords&, Progress& progress)
{
    const auto organ = inputs.config.get<steps::OrganOptions>();
    steps::Segmentation found = organ.isColon()
                                    ? steps::segmentColon(artefacts.volume(), inputs.gravity,
                                                          inputs.config.get<steps::SegmentOptions>(), progress)
                                    : steps::segmentOrgan(artefacts.volume(), organ, progress);
    json result = found.measures;
    result["verdict"] = found.verdict;
    result["confidence"] = found.confidence;
    result["reason"] = found.reason;
    result["plan"] = toJson(found.plan);
    json& bridges = result["bridges"] = json::array();
    for (const Bridge& bridge : found.plan.bridges)
        bridges.push_back({{"from_mm", {bridge.from_mm.x, bridge.from_mm.y, bridge.from_mm.z}},
                           {"to_mm", {bridge.to_mm.x, bridge.to_mm.y, bridge.to_mm.z}},
                           {"length_mm", bridge.length_mm},
                           {"confidence", bridge.confidence},
                           {"certain", bridge.certain},
                           {"reason", bridge.reason}});
    if (!found.verdict.starts_with("no ")) {
        artefacts.put(std::move(found.inside));
        artefacts.densitiesAroundLumen();  // while the whole is there
    }
    return result;
}

std::vector<std::string> segmentFiles(const json& result)
{
    if (result.value("verdict", "").starts_with("no "))
        return {};
    return {"inside.mha"};
}

/// The skeleton of an organ that branches.
json runTree(const steps::LumenPlan& plan, const StepInputs& inputs, ScanArtefacts& artefacts, Progress& progress)
{
    steps::TreeResult found = steps::findTree(artefacts.inside(), plan.pieces.at(0).rectal_end_mm,
                                              inputs.config.get<steps::OrganOptions>().branch_mm,
                                              inputs.config.get<steps::SkeletonOptions>(), progress);
    const std::vector<int> tips = found.tree.tips();
    json result = {{"branches", found.tree.branches.size()},
                   {"tips", tips.size()},
                   {"length_mm", found.tree.pathTo(tips.front()).length_mm()},
                   {"total_length_mm", found.tree.totalLength_mm()}};
    scan_files::writeSkeletonVoxels(artefacts.target("skeleton_voxels.vtp"), found.voxels);
    scan_files::writeSkeletonTree(artefacts.target("skeleton.vtp"), found.tree);
    return result;
}

json runSkeleton(const StepInputs& inputs, ScanArtefacts& artefacts, const StepRecords& records, Progress& progress)
{
    const steps::LumenPlan plan = steps::lumenPlanFromJson(records.at("segment").result.at("plan"));
    if (!isColon(inputs.config))
        return runTree(plan, inputs, artefacts, progress);
    // Two thirds of dividing the lumen need no curve, and cores are free here.
    const steps::SkeletonHooks hooks{
        .core_free = [&] { artefacts.beginSurface(inputs.config.get<steps::WallDensities>()); },
        .paths_found =
            [&](const std::vector<std::vector<Index3>>& paths) {
                if (inputs.config.get<steps::SubdivideOptions>().method == "flood")
                    artefacts.keepFlood(std::async(std::launch::async, [&inside = artefacts.inside(), paths] {
                        return steps::floodFromPaths(inside, paths);
                    }));
            }};
    steps::SkeletonResult found =
        steps::findSkeleton(artefacts.inside(), plan, inputs.config.get<steps::SkeletonOptions>(), progress, hooks);
    json result = found.measures;
    result["length_mm"] = found.curve.length_mm();
    scan_files::writeSkeletonVoxels(artefacts.target("skeleton_voxels.vtp"), found.voxels);
    artefacts.put(std::move(found.curve));
    return result;
}

json runQuality(const StepInputs& inputs, ScanArtefacts& artefacts, const StepRecords& records, Progress& progress)
{
    if (!isColon(inputs.config))
        return {{"not_measured", "parts and quality are those of a colon"}};
    const auto options = inputs.config.get<steps::QualityOptions>();
    const steps::FoundParts found = steps::findColonParts(artefacts.skeleton());
    json result = {{"parts", toJson(found.ranges)}};
    if (!found.reason.empty())
        result["parts_unknown"] = found.reason;
    if (!artefacts.skeleton().empty())
        result["quality"] =
            toJson(steps::measureQuality(artefacts.inside(), artefacts.skeleton(), found.ranges,
                                         records.at("segment").result.at("noise_hu").get<double>(), options, progress),
                   options);
    return result;
}

json runSubdivide(const StepInputs& inputs, ScanArtefacts& artefacts, const StepRecords&, Progress& progress)
{
    PartOfProgress divide(progress, 0, 0.6), tell(progress, 0.6, 0.9), project(progress, 0.9, 1);
    const InsideVolume& inside = artefacts.inside();
    const auto contour = artefacts.surface(inputs.config.get<steps::WallDensities>());
    auto options = inputs.config.get<steps::SubdivideOptions>();
    const SkeletonTree tree = scan_files::readSkeletonTree(artefacts.source("skeleton.vtp"));
    if (!tree.empty())
        options.method = "flood";  // planes across one path do not part branches
    steps::Subdivided divided =
        steps::subdivide(inside, tree.empty() ? artefacts.skeleton() : tree.allBranches(),
                         scan_files::readSkeletonVoxels(artefacts.source("skeleton_voxels.vtp")), options, divide,
                         artefacts.takeFlood());
    artefacts.put(std::move(divided.segments));
    const CellSurface surface = contour.get().cellsOf(artefacts.segments(), tell);
    steps::countTriangles(surface, divided.description);
    auto cells =
        std::async(std::launch::async, [&] { scan_files::writeCells(artefacts.target("cells.vtp"), surface); });
    scan_files::writeProjections(artefacts.target("projections"),
                                 steps::project(surface, inputs.config.get<steps::ProjectionOptions>(), project));
    scan_files::writeSubdivision(artefacts.target("subdivision.json"), divided.description);
    cells.get();
    json result = divided.description.statistics;
    result["method"] = divided.description.method;
    result["triangles"] = surface.triangleCount();
    return result;
}

json runPotential(const StepInputs& inputs, ScanArtefacts& artefacts, const StepRecords&, Progress& progress)
{
    PartOfProgress wall(progress, 0, 0.3), exit(progress, 0.3, 1);
    const auto largest = [](const FieldVolume& field) {
        return *std::max_element(field.voxels.begin(), field.voxels.end());
    };
    json result;
    const auto surface = artefacts.surface(inputs.config.get<steps::WallDensities>());
    FieldVolume from_wall_mm = steps::wallDistance(artefacts.inside(), surface.get().nearWall(), wall);
    result["largest_wall_distance_mm"] = largest(from_wall_mm);
    artefacts.write("wall_distance.mha", std::move(from_wall_mm));
    const SkeletonTree tree = scan_files::readSkeletonTree(artefacts.source("skeleton.vtp"));
    FieldVolume from_exit_mm = tree.empty() ? steps::exitDistance(artefacts.inside(), artefacts.skeleton(), exit)
                                            : steps::exitDistance(artefacts.inside(), tree, exit);
    result["largest_exit_distance_mm"] = largest(from_exit_mm);
    artefacts.write("exit_distance.mha", std::move(from_exit_mm));
    return result;
}

}  // namespace

const std::vector<Step>& stepTable()
{
    using namespace steps;
    static const std::vector<Step> kTable = {
        {"resample",
         2,
         0,
         0.3,
         {},
         Densities::whole,
         always({"volume.mha"}),
         parametersFrom<ResampleOptions>,
         runResample},
        {"segment",
         13,
         0.3,
         0.55,
         {"resample"},
         Densities::whole,
         segmentFiles,
         parametersByOrgan<SegmentOptions, OrganOptions>,
         runSegment},
        {"skeleton",
         10,
         0.55,
         0.65,
         {"segment"},
         Densities::around_lumen,
         always({"skeleton.vtp", "skeleton_voxels.vtp"}),
         parametersByOrgan<SkeletonOptions, SkeletonOptions>,
         runSkeleton},
        {"quality",
         2,
         0.65,
         0.67,
         {"segment", "skeleton"},
         Densities::none,
         always({}),
         parametersFrom<QualityOptions>,
         runQuality},
        {"subdivide",
         5,
         0.67,
         0.85,
         {"resample", "segment", "skeleton"},
         Densities::around_lumen,
         always({"segments.mha", "subdivision.json", "cells.vtp", "projections/coronal.png",
                 "projections/transverse.png", "projections/sagittal.png", "projections/projections.json"}),
         parametersFrom<SubdivideOptions, WallDensities, ProjectionOptions>,
         runSubdivide},
        {"potential",
         3,
         0.85,
         1,
         {"resample", "segment", "skeleton"},
         Densities::around_lumen,
         always({"exit_distance.mha", "wall_distance.mha"}),
         parametersFrom<WallDensities>,
         runPotential},
    };
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
    add(specsOf<steps::OrganOptions>());
    add(specsOf<steps::SkeletonOptions>());
    add(specsOf<steps::QualityOptions>());
    add(specsOf<steps::SubdivideOptions>());
    add(specsOf<steps::ProjectionOptions>());
    return all;
}

}  // namespace vicon::pipeline

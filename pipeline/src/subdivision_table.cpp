#include "vicon/pipeline/subdivision_table.h"

#include "part_of_progress.h"
#include "scan_results.h"
#include "tissue_step.h"
#include "vicon/core/skeleton_tree.h"
#include "vicon/core/temporary_folder.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/steps/cells.h"

namespace vicon::pipeline {
namespace {

std::vector<steps::SubdivideOptions> allWays(const steps::SubdivideOptions& configured, bool branches)
{
    steps::SubdivideOptions way = configured;
    way.method = SubdivideMethod::flood;
    std::vector<steps::SubdivideOptions> all{way};
    if (branches)
        return all;
    way.method = SubdivideMethod::thesis;
    for (const auto& [size, size_name] : steps::kSegmentSizeNames)
        for (const auto& [effectiveness, name] : steps::kPortalEffectivenessNames) {
            way.size = size;
            way.effectiveness = effectiveness;
            all.push_back(way);
        }
    return all;
}

}  // namespace

std::vector<SubdivisionRow> subdivisionTable(const std::filesystem::path& scan_folder, const Config& config,
                                             Quantity quantity, Progress& progress)
{
    // Nothing is written; the folder goes with the results.
    ScanResults results(scan_folder, makeTemporaryFolder("vicon-table-", ErrorCode::store), quantity);
    const SkeletonTree tree = scan_files::readSkeletonTree(results.source("skeleton.vtp"));
    const Skeleton skeleton = tree.empty() ? results.skeleton() : tree.allBranches();
    const SkeletonVoxels voxels = scan_files::readSkeletonVoxels(results.source("skeleton_voxels.vtp"));
    const auto contour = surfaceOf(config, results);
    const auto ways = allWays(config.get<steps::SubdivideOptions>(), !tree.empty());
    std::vector<SubdivisionRow> rows;
    for (const steps::SubdivideOptions& way : ways) {
        const double from = double(rows.size()) / double(ways.size()), part = 1 / double(ways.size());
        PartOfProgress divide(progress, from, from + 0.7 * part), tell(progress, from + 0.7 * part, from + part);
        steps::Subdivided divided = steps::subdivide(results.inside(), skeleton, voxels, way, divide);
        steps::countTriangles(contour.get().cellsOf(divided.segments, tell), divided.description);
        rows.push_back({way, divided.description.statistics});
    }
    return rows;
}

}  // namespace vicon::pipeline

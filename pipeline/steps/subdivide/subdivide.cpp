#include "vicon/steps/subdivide.h"

#include <algorithm>
#include <cmath>

#include "subdivide/flood.h"
#include "subdivide/portals.h"
#include "subdivide/thesis/subdivision.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

double skeletonLength_mm(const Skeleton& skeleton)
{
    double length = 0;
    for (const SkeletonPiece& piece : skeleton.pieces)
        if (!piece.bridge)
            length += piece.points.back().station_mm - piece.points.front().station_mm;
    return length;
}

nlohmann::json statisticsOf(const Subdivided& result, int specified)
{
    double thickest = 0, largest = 0;
    std::size_t most = 0, fewest = result.segments.voxels.size();
    for (const auto& portal : result.description.portals) {
        thickest = std::max(thickest, thicknessOf(portal, result.segments.grid));
        largest = std::max(largest, portal.area_mm2);
    }
    for (const auto& segment : result.description.segments) {
        most = std::max(most, segment.inside_voxels);
        fewest = std::min(fewest, segment.inside_voxels);
    }
    return {{"specified_segments", specified},
            {"segments", result.description.segments.size()},
            {"portals", result.description.portals.size()},
            {"portal_thickness_largest_mm", thickest},
            {"portal_area_largest_mm2", largest},
            {"inside_voxels_largest", most},
            {"inside_voxels_smallest", fewest}};
}

/// Portals, description and statistics of numbered segments.
Subdivided describe(NumberedSegments numbered, std::optional<SubdivideMethod> method, const SubdivideOptions& options,
                    int specified)
{
    Subdivided result;
    result.description.method = method;
    result.description.parameters = toJson(options);
    result.description.portals = findPortals(numbered);
    result.description.segments = std::move(numbered.infos);
    result.segments = std::move(numbered.segments);
    result.description.statistics = statisticsOf(result, specified);
    return result;
}

}  // namespace

Subdivided undivided(const InsideVolume& inside, const SubdivideOptions& options, Progress& progress)
{
    std::vector<std::uint16_t> label(inside.voxels.size());
    std::transform(inside.voxels.begin(), inside.voxels.end(), label.begin(),
                   [](std::uint8_t voxel) { return std::uint16_t(voxel != kOutside); });
    if (std::find(label.begin(), label.end(), 1) == label.end())
        throw Error(ErrorCode::bad_input, "nothing is inside");
    Subdivided result = describe(numberSegments(inside, label, {LabelledPiece{}}, {}), {}, options, 1);
    progress.report(1, "subdividing");
    return result;
}

Subdivided subdivide(const InsideVolume& inside, const Skeleton& skeleton, const SkeletonVoxels& voxels,
                     const SubdivideOptions& options, Progress& progress, std::optional<PathFlood> flood)
{
    if (skeleton.empty())
        throw Error(ErrorCode::bad_input, "the skeleton is empty");
    progress.report(0, "subdividing");
    const double total_mm = skeletonLength_mm(skeleton);
    const double length_mm = options.segments > 0 ? total_mm / options.segments : options.length_mm;
    const int specified = options.segments > 0 ? options.segments : std::max(1, int(std::lround(total_mm / length_mm)));

    const std::vector<Path> paths = pathsOf(inside, skeleton, voxels);
    const ThesisPieces pieces = options.method == SubdivideMethod::thesis
                                    ? thesisPieces(inside, skeleton, paths, options, specified, progress)
                                    : ThesisPieces{floodPieces(inside, skeleton, paths, length_mm, std::move(flood))};
    progress.check();
    progress.report(0.6, "subdividing");

    std::vector<std::size_t> anchors;
    for (const Path& path : paths)
        for (const PathVoxel& v : path.voxels)
            anchors.push_back(v.voxel);
    NumberedSegments numbered = numberSegments(inside, pieces.labelling.label, pieces.labelling.pieces, anchors);
    progress.check();
    progress.report(0.8, "subdividing");

    Subdivided result = describe(std::move(numbered), options.method, options, specified);
    result.description.statistics.update(pieces.measures);
    progress.report(1, "subdividing");
    return result;
}

}  // namespace vicon::steps

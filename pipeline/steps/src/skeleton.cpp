#include "vicon/steps/skeleton.h"

#include <algorithm>

#include "skeleton_path.h"
#include "skeleton_smooth.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

constexpr int kBlock = 2;        // half resolution: as exact after recentring as full, and four times faster
constexpr double kLeast_mm = 0;  // narrow lumens are kept; the cost keeps the path away from corners of the wall

/// Appends points with their stations, which go on from the end of what is there.
void append(Skeleton& skeleton, const Polyline& line, bool bridge, const DistanceProbe& wall)
{
    double station = skeleton.length_mm();
    SkeletonPiece piece{bridge, {}};
    for (std::size_t n = 0; n < line.size(); ++n) {
        if (n > 0)
            station += distance(line[n - 1], line[n]);
        piece.points.push_back({line[n], station, wall.at(line[n])});
    }
    skeleton.pieces.push_back(std::move(piece));
}

/// From the end of one curve to the start of the next along the bridge's path, without the detours to the tips of the
/// lumen, which lie a local radius beyond the curves' ends and often in a corner.
Polyline bridgeLine(Point3 from, const Bridge& bridge, Point3 to, const SkeletonOptions& options)
{
    Polyline line{from};
    for (std::size_t n = 1; n + 1 < bridge.path_mm.size(); ++n)
        line.push_back(bridge.path_mm[n]);
    line.push_back(to);
    line = smoothed(resampled(line, options.step_mm), options.smoothing_mm, options.step_mm);
    line.front() = from;
    line.back() = to;
    return line;
}

}  // namespace

SkeletonResult findSkeleton(const InsideVolume& inside, const LumenPlan& plan, const SkeletonOptions& options,
                            Progress& progress)
{
    SkeletonResult result;
    result.measures["pieces"] = nlohmann::json::array();
    if (plan.pieces.empty())
        return result;
    const FieldVolume wall_mm = wallDistance(inside, progress);
    progress.report(0.3, "skeleton");
    const DistanceProbe wall(wall_mm);
    const LumenGraph graph = makeGraph(wall_mm, kBlock, kLeast_mm);
    std::vector<Polyline> curves;
    for (std::size_t n = 0; n < plan.pieces.size(); ++n) {
        const LumenPath path =
            findPath(wall_mm, graph, plan.pieces[n].rectal_end_mm, plan.pieces[n].caecal_end_mm, options, progress);
        Polyline voxels;
        for (const Index3 v : path.voxels)
            voxels.push_back(inside.grid.pointAt(v));
        curves.push_back(centredCurve(voxels, wall, options));
        result.voxels.push_back(std::move(voxels));
        result.measures["pieces"].push_back({{"uncovered_fraction", path.uncovered_fraction},
                                             {"cut_contacts", path.cuts},
                                             {"path_voxels", path.voxels.size()}});
        progress.report(0.3 + 0.7 * double(n + 1) / double(plan.pieces.size()), "skeleton");
    }
    for (std::size_t n = 0; n < curves.size(); ++n) {
        append(result.curve, curves[n], false, wall);
        if (n + 1 < curves.size())
            append(result.curve, bridgeLine(curves[n].back(), plan.bridges.at(n), curves[n + 1].front(), options), true,
                   wall);
    }
    result.measures["length_mm"] = result.curve.length_mm();
    return result;
}

}  // namespace vicon::steps

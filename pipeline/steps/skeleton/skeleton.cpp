#include "vicon/steps/skeleton.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>

#include "grid/check_only.h"
#include "skeleton/detour.h"
#include "skeleton/join.h"
#include "skeleton/path.h"
#include "skeleton/rectal_tube.h"
#include "skeleton/smooth.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// Half resolution: as exact after recentring as full, and four times faster. On thirds the phantoms and shapes come out
// as well, but the curve through ctc-prone turns sharply (28 degrees in 5 mm) over 240 instead of 206 mm, on quarters
// 258.
constexpr int kBlock = 2;
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

/// Hands the paths of the pieces on: the first ones once all have one, the last ones where they are others.
class PathsFound {
public:
    PathsFound(std::size_t pieces, const SkeletonHooks& hooks) : voxels_(pieces), hooks_(hooks) {}

    /// On any thread, but one for each piece. Of a piece that is sought in several graphs the first counts.
    void takeFirst(std::size_t piece, const std::vector<Index3>& voxels)
    {
        if (!voxels_[piece].empty())
            return;
        voxels_[piece] = voxels;
        if (++found_ == voxels_.size())
            tell();
    }
    void takeLast(const std::vector<LumenPath>& paths)
    {
        bool same = found_ == paths.size();
        for (std::size_t n = 0; n < paths.size(); ++n) {
            same = same && voxels_[n] == paths[n].voxels;
            voxels_[n] = paths[n].voxels;
        }
        if (!same)
            tell();
    }

private:
    void tell() const
    {
        if (hooks_.paths_found)
            hooks_.paths_found(voxels_);
    }

    std::vector<std::vector<Index3>> voxels_;
    std::atomic<std::size_t> found_ = 0;
    const SkeletonHooks& hooks_;
};

}  // namespace

SkeletonResult findSkeleton(const InsideVolume& inside, const LumenPlan& plan, const SkeletonOptions& options,
                            Progress& progress, const SkeletonHooks& hooks)
{
    SkeletonResult result;
    result.measures["pieces"] = nlohmann::json::array();
    if (plan.pieces.empty())
        return result;
    const FieldVolume wall_mm = wallDistance(inside, progress);
    progress.report(0.3, "skeleton");
    FieldVolume over_tube_mm;
    CheckOnly check(progress);
    std::vector<LumenPath> paths(plan.pieces.size());
    PathsFound found(paths.size(), hooks);
    tbb::parallel_invoke(
        [&] {
            const LumenGraph graph = makeGraph(wall_mm, kBlock, kLeast_mm);
            tbb::parallel_for(std::size_t(0), paths.size(), [&](std::size_t n) {
                const LumenPiece& piece = plan.pieces[n];
                paths[n] = findPath(wall_mm, graph, piece.rectal_end_mm, piece.caecal_end_mm, options, check,
                                    [&](const std::vector<Index3>& voxels) { found.takeFirst(n, voxels); });
            });
        },
        [&] {
            over_tube_mm = wallDistanceOverTube(inside, plan.pieces.front().rectal_end_mm, check);
            if (hooks.core_free)
                hooks.core_free();
        });
    found.takeLast(paths);
    const DistanceProbe open(wall_mm, over_tube_mm);
    std::vector<Polyline> curves;
    for (std::size_t n = 0; n < plan.pieces.size(); ++n) {
        const LumenPath& path = paths[n];
        Polyline voxels;
        for (const Index3 v : path.voxels)
            voxels.push_back(inside.grid.pointAt(v));
        curves.push_back(centredCurve(voxels, open, options));
        result.voxels.push_back(std::move(voxels));
        result.measures["pieces"].push_back({{"uncovered_fraction", path.uncovered_fraction},
                                             {"cut_contacts", path.cuts},
                                             {"path_voxels", path.voxels.size()}});
        progress.report(0.3 + 0.7 * double(n + 1) / double(plan.pieces.size()), "skeleton");
    }
    std::vector<Polyline> bridges;
    for (std::size_t n = 0; n + 1 < curves.size(); ++n)
        bridges.push_back(joined(curves[n], plan.bridges.at(n).path_mm, curves[n + 1], open, options));
    const DistanceProbe wall(wall_mm);
    for (std::size_t n = 0; n < curves.size(); ++n) {
        append(result.curve, besideTube(curves[n], wall, options.step_mm), false, open);
        if (n < bridges.size())
            append(result.curve, bridges[n], true, open);
    }
    result.measures["length_mm"] = result.curve.length_mm();
    return result;
}

}  // namespace vicon::steps

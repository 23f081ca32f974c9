#include <algorithm>
#include <cmath>

#include "organ/branches.h"
#include "skeleton/smooth.h"
#include "vicon/core/error.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

/// Appends points of a curve with their stations, and the distance to the wall.
void append(std::vector<SkeletonPoint>& to, const Polyline& curve, std::size_t from, std::size_t end,
            const DistanceProbe& wall)
{
    for (std::size_t n = from; n < end; ++n) {
        const double step_mm = to.empty() ? 0 : distance(to.back().position_mm, curve[n]);
        if (to.empty() || step_mm > 1e-6)
            to.push_back({curve[n], to.empty() ? 0 : to.back().station_mm + step_mm, wall.at(curve[n])});
    }
}

/// Fits one smooth curve to the way from the root to each tip, and hands each branch its part of the first way that
/// runs through it.
class TreeFit {
public:
    TreeFit(const LumenGraph& graph, const std::vector<NodeBranch>& branches, const DistanceProbe& wall,
            const SkeletonOptions& options)
        : graph_(graph), branches_(branches), wall_(wall), options_(options)
    {
    }

    SkeletonTree fit(Progress& progress)
    {
        tree_.branches.resize(branches_.size());
        for (std::size_t n = 0; n < branches_.size(); ++n) {
            const bool tip = n + 1 == branches_.size() || branches_[n + 1].parent != int(n);
            if (tip)
                fitWay(int(n));
            progress.check();
            progress.report(0.5 + 0.5 * double(n + 1) / double(branches_.size()), "skeleton");
        }
        return std::move(tree_);
    }

private:
    /// Branches from the root to this one.
    std::vector<int> wayTo(int branch) const
    {
        std::vector<int> way;
        for (int n = branch; n >= 0; n = branches_[std::size_t(n)].parent)
            way.push_back(n);
        std::reverse(way.begin(), way.end());
        return way;
    }

    void fitWay(int tip)
    {
        const std::vector<int> way = wayTo(tip);
        Polyline path;
        std::vector<Point3> forks;
        for (const int n : way) {
            for (const std::int32_t node : branches_[std::size_t(n)].nodes)
                if (path.empty() || distance(path.back(), graph_.point(node)) > 0)
                    path.push_back(graph_.point(node));
            forks.push_back(path.back());
        }
        const Polyline curve = centredCurve(path, wall_, options_);
        std::size_t at = 0;
        for (std::size_t w = 0; w < way.size(); ++w) {
            auto& branch = tree_.branches[std::size_t(way[w])];
            branch.parent = branches_[std::size_t(way[w])].parent;
            branch.generation = branches_[std::size_t(way[w])].generation;
            const std::size_t end =
                w + 1 == way.size() ? curve.size() : std::max(at + 1, nearest(curve, forks[w], at) + 1);
            if (branch.points.empty())
                give(branch, curve, at, std::min(end, curve.size()));
            at = std::min(end, curve.size()) - 1;
        }
    }

    static std::size_t nearest(const Polyline& curve, Point3 p, std::size_t from)
    {
        std::size_t best = from;
        for (std::size_t n = from; n < curve.size(); ++n)
            if (distance(curve[n], p) < distance(curve[best], p))
                best = n;
        return best;
    }

    /// Points [from, end) of the curve are the branch's; it begins at its parent's end, from which the curve may differ
    /// a little, because it was fitted to another way: the difference fades out over the local radius.
    void give(SkeletonBranch& branch, const Polyline& curve, std::size_t from, std::size_t end)
    {
        Polyline line(curve.begin() + std::ptrdiff_t(from), curve.begin() + std::ptrdiff_t(end));
        if (branch.parent >= 0) {
            const SkeletonPoint fork = tree_.branches[std::size_t(branch.parent)].points.back();
            const Vector3 off = fork.position_mm - line.front();
            const double fade_mm = std::max(2 * options_.step_mm, fork.radius_mm);
            for (std::size_t n = 0; n < line.size(); ++n) {
                const double share = std::max(0.0, 1 - double(n) * options_.step_mm / fade_mm);
                line[n] = keptInside(line[n] + off * share, line[n], wall_);
            }
            line.front() = fork.position_mm;
            branch.points.push_back(fork);
        }
        append(branch.points, line, 0, line.size(), wall_);
        if (branch.points.size() == 1) {  // as short as a step of the curve
            SkeletonPoint twin = branch.points.back();
            branch.points.push_back(twin);
        }
    }

    const LumenGraph& graph_;
    const std::vector<NodeBranch>& branches_;
    const DistanceProbe& wall_;
    const SkeletonOptions& options_;
    SkeletonTree tree_;
};

}  // namespace

TreeResult findTree(const InsideVolume& inside, Point3 root_mm, double branch_mm, const SkeletonOptions& options,
                    Progress& progress)
{
    TreeResult result;
    const FieldVolume wall_mm = wallDistance(inside, progress);
    progress.report(0.2, "skeleton");
    const LumenGraph graph = makeGraph(wall_mm, 1, 0);
    const std::int32_t root = graph.nearest(root_mm);
    if (root < 0)
        throw Error(ErrorCode::bad_input, "there is no lumen to find a skeleton of");
    const LumenTree tree = centralTree(graph, root, {}, progress);
    const std::vector<NodeBranch> branches = branchesOf(graph, tree, branch_mm, progress);
    progress.report(0.5, "skeleton");
    const DistanceProbe wall(wall_mm);
    result.tree = TreeFit(graph, branches, wall, options).fit(progress);
    for (const NodeBranch& branch : branches) {
        auto& voxels = result.voxels.emplace_back();
        for (const std::int32_t node : branch.nodes)
            voxels.push_back(graph.point(node));
    }
    return result;
}

}  // namespace vicon::steps

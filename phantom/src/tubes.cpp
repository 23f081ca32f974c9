#include "tubes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vicon::phantom {
namespace {

/// Distance to the cone between two balls: the ball around the nearest place of its axis, near enough for slow tapers.
double coneDistance(const SkeletonPoint& a, const SkeletonPoint& b, Point3 p)
{
    const Vector3 ab = b.position_mm - a.position_mm;
    const double t = std::clamp(dot(p - a.position_mm, ab) / std::max(1e-9, dot(ab, ab)), 0.0, 1.0);
    return distance(p, a.position_mm + ab * t) - std::lerp(a.radius_mm, b.radius_mm, t);
}

template <class Use>
void forEachStretch(const SkeletonTree& tree, Use use)
{
    for (const SkeletonBranch& branch : tree.branches)
        for (std::size_t n = 0; n + 1 < branch.points.size(); ++n)
            use(branch.points[n], branch.points[n + 1]);
}

}  // namespace

double tubesDistance(const SkeletonTree& tree, Point3 p, double limit_mm)
{
    double least = limit_mm;
    forEachStretch(
        tree, [&](const SkeletonPoint& a, const SkeletonPoint& b) { least = std::min(least, coneDistance(a, b, p)); });
    return least;
}

FieldVolume tubesField(const Grid& grid, const SkeletonTree& tree, double limit_mm)
{
    FieldVolume field(grid, float(limit_mm));
    forEachStretch(tree, [&](const SkeletonPoint& a, const SkeletonPoint& b) {
        const double reach = std::max(a.radius_mm, b.radius_mm) + limit_mm;
        const ContinuousIndex3 ca = grid.continuousIndexAt(a.position_mm), cb = grid.continuousIndexAt(b.position_mm);
        const auto range = [&](double from, double to, std::size_t axis) {
            const double more = reach / grid.spacing_mm[axis];
            return std::pair(std::max(0, int(std::floor(std::min(from, to) - more))),
                             std::min(grid.size[axis] - 1, int(std::ceil(std::max(from, to) + more))));
        };
        const auto [i0, i1] = range(ca.i, cb.i, 0);
        const auto [j0, j1] = range(ca.j, cb.j, 1);
        const auto [k0, k1] = range(ca.k, cb.k, 2);
        tbb::parallel_for(k0, k1 + 1, [&, i0 = i0, i1 = i1, j0 = j0, j1 = j1](int k) {
            for (int j = j0; j <= j1; ++j)
                for (int i = i0; i <= i1; ++i) {
                    float& own = field.at({i, j, k});
                    own = std::min(own, float(coneDistance(a, b, grid.pointAt(Index3{i, j, k}))));
                }
        });
    });
    return field;
}

int addBranch(SkeletonTree& tree, int parent, const std::vector<Point3>& points, const std::vector<double>& radii_mm)
{
    SkeletonBranch branch{parent, parent < 0 ? 0 : tree.branches[std::size_t(parent)].generation + 1, {}};
    double station_mm = parent < 0 ? 0 : tree.branches[std::size_t(parent)].points.back().station_mm;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (n > 0)
            station_mm += distance(points[n - 1], points[n]);
        branch.points.push_back({points[n], station_mm, radii_mm[n]});
    }
    tree.branches.push_back(std::move(branch));
    return int(tree.branches.size()) - 1;
}

SkeletonTree inOrder(const SkeletonTree& tree)
{
    std::vector<double> farthest(tree.branches.size(), 0);
    for (std::size_t n = tree.branches.size(); n-- > 0;) {
        const SkeletonBranch& branch = tree.branches[n];
        farthest[n] = std::max(farthest[n], branch.points.back().station_mm);
        if (branch.parent >= 0)
            farthest[std::size_t(branch.parent)] = std::max(farthest[std::size_t(branch.parent)], farthest[n]);
    }
    SkeletonTree out;
    const std::function<void(std::size_t, int)> add = [&](std::size_t n, int parent) {
        const int own = int(out.branches.size());
        out.branches.push_back(tree.branches[n]);
        out.branches.back().parent = parent;
        std::vector<std::size_t> children;
        for (std::size_t m = 0; m < tree.branches.size(); ++m)
            if (tree.branches[m].parent == int(n))
                children.push_back(m);
        std::stable_sort(children.begin(), children.end(),
                         [&](std::size_t a, std::size_t b) { return farthest[a] > farthest[b]; });
        for (const std::size_t m : children)
            add(m, own);
    };
    add(0, -1);
    return out;
}

}  // namespace vicon::phantom

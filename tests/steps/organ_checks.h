#pragma once

// How well a found organ agrees with its phantom's truth.

#include <algorithm>
#include <vector>

#include "vicon/core/skeleton_tree.h"
#include "vicon/core/volume.h"

namespace vicon::steps::test {

/// Of two masks on grids of their own, over the voxels of the finer lattice `found`.
inline double dice(const InsideVolume& truth, const InsideVolume& found)
{
    std::size_t both = 0, in_found = 0, in_truth = 0;
    for (std::size_t n = 0; n < found.voxels.size(); ++n) {
        const bool a = found.voxels[n] != kOutside;
        const bool b =
            truth.valueOr(truth.grid.indexAt(found.grid.pointAt(found.grid.indexOf(n))), kOutside) != kOutside;
        in_found += a;
        both += a && b;
    }
    for (const std::uint8_t v : truth.voxels)
        in_truth += v != kOutside;
    const double truth_mm3 = double(in_truth) * truth.grid.voxelVolume_mm3();
    return 2 * double(both) * found.grid.voxelVolume_mm3() /
           (truth_mm3 + double(in_found) * found.grid.voxelVolume_mm3());
}

inline double distanceTo(const std::vector<SkeletonPoint>& line, Point3 p)
{
    double least = 1e300;
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
        const Point3 a = line[n].position_mm;
        const Vector3 ab = line[n + 1].position_mm - a;
        const double t = std::clamp(dot(p - a, ab) / std::max(1e-9, dot(ab, ab)), 0.0, 1.0);
        least = std::min(least, distance(p, a + ab * t));
    }
    return least;
}

inline double distanceTo(const SkeletonTree& tree, Point3 p)
{
    double least = 1e300;
    for (const SkeletonBranch& branch : tree.branches)
        least = std::min(least, distanceTo(branch.points, p));
    return least;
}

/// The truth's branches of some generations.
inline SkeletonTree generations(const SkeletonTree& tree, int from, int to)
{
    SkeletonTree out;
    for (const SkeletonBranch& branch : tree.branches)
        if (branch.generation >= from && branch.generation <= to)
            out.branches.push_back(branch);
    return out;
}

struct TreeAgreement {
    int branches = 0;  ///< of the truth
    int found = 0;     ///< whose outer half, without the tip's ball, has a found skeleton all along
    int extra = 0;     ///< found tips whose last 5 mm lie beside every true axis by more than its radius
    double mean_mm = 0, worst_percentile_mm = 0;  ///< found points to the true axes; the 95th percentile
    double total_length_share = 0;                ///< found over true
};

inline TreeAgreement compare(const SkeletonTree& truth, const SkeletonTree& found)
{
    TreeAgreement out;
    for (const SkeletonBranch& branch : truth.branches) {
        ++out.branches;
        const Skeleton one{{{false, branch.points}}};
        const double from = branch.points.front().station_mm, to = branch.points.back().station_mm;
        bool all = true;
        for (double s = (from + to) / 2; s < to - branch.points.back().radius_mm * 1.5; s += 1) {
            const SkeletonPoint p = one.at(s);
            all = all && distanceTo(found, p.position_mm) < std::max(2.5, p.radius_mm);
        }
        out.found += all;
    }
    std::vector<double> away;
    for (const SkeletonBranch& branch : found.branches)
        for (const SkeletonPoint& p : branch.points)
            away.push_back(distanceTo(truth, p.position_mm));
    std::sort(away.begin(), away.end());
    for (const double mm : away)
        out.mean_mm += mm / double(away.size());
    out.worst_percentile_mm = away[away.size() * 95 / 100];
    for (const int tip : found.tips()) {
        const Point3 end = found.branches[std::size_t(tip)].points.back().position_mm;
        out.extra += distanceTo(truth, end) > 3;
    }
    out.total_length_share = found.totalLength_mm() / truth.totalLength_mm();
    return out;
}

}  // namespace vicon::steps::test

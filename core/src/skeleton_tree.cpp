#include "vicon/core/skeleton_tree.h"

#include <algorithm>
#include <string>

#include "vicon/core/error.h"

namespace vicon {

std::vector<int> SkeletonTree::tips() const
{
    std::vector<bool> forks(branches.size(), false);
    for (const SkeletonBranch& branch : branches)
        if (branch.parent >= 0)
            forks[std::size_t(branch.parent)] = true;
    std::vector<int> found;
    for (std::size_t n = 0; n < branches.size(); ++n)
        if (!forks[n])
            found.push_back(int(n));
    const auto end_mm = [&](int n) { return branches[std::size_t(n)].points.back().station_mm; };
    std::stable_sort(found.begin(), found.end(), [&](int a, int b) { return end_mm(a) > end_mm(b); });
    return found;
}

Skeleton SkeletonTree::pathTo(int branch) const
{
    if (branch < 0 || std::size_t(branch) >= branches.size())
        throw Error(ErrorCode::wrong_use, "the skeleton has no branch " + std::to_string(branch), {},
                    "it has the branches 0 to " + std::to_string(int(branches.size()) - 1) + "; see 'vicon show'");
    std::vector<int> way;
    for (int n = branch; n >= 0; n = branches[std::size_t(n)].parent)
        way.push_back(n);
    SkeletonPiece piece;
    for (auto n = way.rbegin(); n != way.rend(); ++n) {
        const auto& points = branches[std::size_t(*n)].points;
        piece.points.insert(piece.points.end(), points.begin() + (piece.points.empty() ? 0 : 1), points.end());
    }
    return {{std::move(piece)}};
}

Skeleton SkeletonTree::allBranches() const
{
    Skeleton all;
    for (const SkeletonBranch& branch : branches)
        all.pieces.push_back({false, branch.points});
    return all;
}

double SkeletonTree::totalLength_mm() const
{
    double sum = 0;
    for (const SkeletonBranch& branch : branches)
        sum += branch.points.back().station_mm - branch.points.front().station_mm;
    return sum;
}

}  // namespace vicon

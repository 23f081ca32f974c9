#include "tissue/closed_walls.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "grid/neighbours.h"
#include "tissue/lumen_of_tissue.h"
#include "tissue/mixture.h"

namespace vicon::steps {
namespace {

using Label = std::uint32_t;
/// How many voxels of a piece lie in a part of the lumen.
using Shares = std::map<std::pair<Label, Label>, std::size_t>;

Shares sharesOf(const RunLabels& pieces, const RunLabels& parts)
{
    Shares shares;
    auto last = shares.end();
    for (std::size_t row = 0; row + 1 < pieces.row_begin.size(); ++row) {
        std::size_t a = pieces.row_begin[row], b = parts.row_begin[row];
        while (a < pieces.row_begin[row + 1] && b < parts.row_begin[row + 1]) {
            const VoxelRun &piece = pieces.runs[a], &part = parts.runs[b];
            const int common = std::min(piece.end, part.end) - std::max(piece.begin, part.begin);
            if (common > 0) {
                const std::pair key(piece.label, part.label);
                if (last == shares.end() || last->first != key)
                    last = shares.try_emplace(key, 0).first;
                last->second += std::size_t(common);
            }
            ++(piece.end < part.end ? a : b);
        }
    }
    return shares;
}

/// The parts of each piece that is in several of more than a speck.
std::vector<std::set<Label>> cutPieces(const RunLabels& pieces, const RunLabels& parts)
{
    std::vector<std::set<Label>> cut(pieces.components.size());
    for (const auto& [of, voxels] : sharesOf(pieces, parts))
        if (voxels > kSpeck_voxels)
            cut[of.first].insert(of.second);
    std::erase_if(cut, [](const std::set<Label>& in) { return in.size() < 2; });
    return cut;
}

}  // namespace

ClosedWall::Voxel closeVoxel(std::size_t at, float fraction, TissueVolume& tissue, InsideVolume& lumen)
{
    const ClosedWall::Voxel before{at, lumen.voxels[at], tissue.voxels[at]};
    lumen.voxels[at] = kOutside;
    tissue.voxels[at] = std::max(tissue.voxels[at], std::uint8_t(fraction * kWhole));
    return before;
}

void reopenCuts(const RunLabels& pieces, std::vector<ClosedWall>& closed, TissueVolume& tissue, InsideVolume& lumen)
{
    if (closed.empty())
        return;
    const RunLabels parts = labelLumen(lumen, Neighbours::faces);
    const std::vector<std::set<Label>> cut = cutPieces(pieces, parts);
    if (cut.empty())
        return;
    const auto cuts = [&](const ClosedWall& wall) {
        std::set<Label> beside;
        for (const ClosedWall::Voxel& voxel : wall.voxels)
            forEachOverFaces(lumen.grid, voxel.at, [&](std::size_t other) {
                if (const int part = parts.labelAt(lumen.grid.indexOf(other)); part >= 0)
                    beside.insert(Label(part));
            });
        return std::ranges::any_of(cut, [&](const std::set<Label>& in) {
            return std::ranges::count_if(beside, [&](Label part) { return in.contains(part); }) > 1;
        });
    };
    const auto opened =
        std::stable_partition(closed.begin(), closed.end(), [&](const auto& wall) { return !cuts(wall); });
    for (auto wall = opened; wall != closed.end(); ++wall)
        for (const ClosedWall::Voxel& voxel : wall->voxels) {
            lumen.voxels[voxel.at] = voxel.label;
            tissue.voxels[voxel.at] = voxel.fraction;
        }
    closed.erase(opened, closed.end());
}

}  // namespace vicon::steps

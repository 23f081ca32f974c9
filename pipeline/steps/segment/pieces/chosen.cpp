#include "segment/pieces/chosen.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "grid/allocate.h"
#include "grid/voxel_box.h"
#include "segment/fluid/rim.h"

namespace vicon::steps {

std::set<int> separated(const RunLabels& lumen, const std::vector<std::vector<Index3>>& around_cuts)
{
    std::set<int> dropped;
    for (const auto& around : around_cuts) {
        std::set<int> parts;
        for (const Index3 v : around)
            if (const int label = lumen.labelAt(v); label >= 0)
                parts.insert(label);
        const auto largest = std::max_element(parts.begin(), parts.end(), [&](int a, int b) {
            return lumen.components[std::size_t(a)].voxels < lumen.components[std::size_t(b)].voxels;
        });
        for (const int part : parts)
            if (part != *largest)
                dropped.insert(part);
    }
    return dropped;
}

InsideVolume cropTo(const InsideVolume& labels, const RunLabels& lumen, const std::set<int>& chosen, int margin)
{
    VoxelBox box;
    for (const int n : chosen) {
        box.take(lumen.components[std::size_t(n)].lower);
        box.take(lumen.components[std::size_t(n)].upper);
    }
    box = box.grown(margin, labels.grid);
    const Index3 lower = box.low;
    const Grid grid = cropped(labels.grid, box);
    auto out = makeVolume<std::uint8_t>(grid);
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        for (int j = 0; j < grid.size[1]; ++j)
            for (int i = 0; i < grid.size[0]; ++i)
                if (labels.at({lower.i + i, lower.j + j, lower.k + k}) == kRim)
                    out.at({i, j, k}) = kRim;
    });
    lumen.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (!chosen.contains(int(run.label)))
            return;
        const std::uint8_t* from = &labels.at({run.begin, j, k});
        std::copy_n(from, run.end - run.begin, &out.at({run.begin - lower.i, j - lower.j, k - lower.k}));
    });
    return out;
}

LumenPiece pieceFor(const Candidate& c, bool reversed)
{
    return {
        c.tip_mm[reversed ? 1 : 0], c.tip_mm[reversed ? 0 : 1], c.volume_ml, c.fluid_ml, c.length_mm, c.max_radius_mm};
}

nlohmann::json describe(const std::vector<Candidate>& candidates, const Ordering& ordering)
{
    nlohmann::json out = nlohmann::json::array();
    for (std::size_t n = 0; n < candidates.size(); ++n) {
        const Candidate& c = candidates[n];
        const auto at = std::find_if(ordering.pieces.begin(), ordering.pieces.end(),
                                     [&](const OrderedPiece& p) { return p.candidate == int(n); });
        out.push_back({{"volume_ml", c.volume_ml},
                       {"fluid_ml", c.fluid_ml},
                       {"length_mm", c.length_mm},
                       {"max_radius_mm", c.max_radius_mm},
                       {"looks_like", nameIn(kCandidateKindNames, c.kind)},
                       {"place_in_colon", at == ordering.pieces.end() ? 0 : at - ordering.pieces.begin() + 1}});
    }
    return out;
}

}  // namespace vicon::steps

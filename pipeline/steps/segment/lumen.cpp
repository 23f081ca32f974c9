#include "segment/lumen.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "grid/allocate.h"
#include "grid/byte_rows.h"
#include "grid/neighbours.h"
#include "segment/constants.h"

namespace vicon::steps {
namespace {

// Lung holds tissue: on average denser than -930 HU where bowel gas is -1000 with a thin blurred edge. No case
// recorded; a synthetic chest and a real one are held by verdict_test and segment_verdict_test.
constexpr double kLungMean_hu = -930;
constexpr double kLungTop_mm = 8;    // lungs leave the scan at its upper end
constexpr double kLungSize_ml = 10;  // below, the blurred edge alone can raise a bubble's mean that far

}  // namespace

RunLabels findGas(const HuVolume& volume, const Body& body, double gas_below_hu)
{
    const int nx = volume.grid.size[0];
    const auto limit = std::int16_t(gas_below_hu);
    const auto scan = [&](int j, int k, std::vector<VoxelRun>& runs) {
        const std::int16_t* hu = &volume.voxels[volume.grid.offset({0, j, k})];
        const std::uint8_t* in_body = &body.inside.at({0, j / body.factor, k / body.factor});
        const std::size_t first = runs.size();
        for (int block = 0; block < body.inside.grid.size[0]; ++block) {
            if (!in_body[block])
                continue;
            for (int i = block * body.factor, end = std::min(nx, i + body.factor); i < end; ++i) {
                if (hu[i] >= limit)
                    continue;
                if (runs.size() == first || runs.back().end != i)
                    runs.push_back({i, i, 0, 0});
                ++runs.back().end;
                runs.back().sum += hu[i];
            }
        }
    };
    return labelRuns(volume.grid.size, scan, Neighbours::faces);
}

bool isLung(const RunComponent& gas, const Grid& grid)
{
    const double ml = double(gas.voxels) * grid.voxelVolume_mm3() / 1000;
    const double below_top_mm = (grid.size[2] - 1 - gas.upper.k) * grid.spacing_mm[2];
    const bool upper_half = gas.centre.k > grid.size[2] / 2.0;
    return gas.mean() > kLungMean_hu && ml > kLungSize_ml && (below_top_mm < kLungTop_mm || upper_half);
}

InsideVolume labelGas(const HuVolume& volume, const RunLabels& gas, const std::vector<int>& always)
{
    auto labels = makeVolume<std::uint8_t>(volume.grid);
    const double voxel_ml = volume.grid.voxelVolume_mm3() / 1000;
    std::vector<std::uint8_t> taken;
    for (const RunComponent& c : gas.components)
        taken.push_back(double(c.voxels) * voxel_ml >= kSpeck_ml && !isLung(c, volume.grid) ? 1 : 0);
    for (const int n : always)
        taken.at(std::size_t(n)) = 1;
    gas.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (taken[run.label])
            std::fill_n(&labels.at({run.begin, j, k}), run.end - run.begin, std::uint8_t(kGas));
    });
    return labels;
}

void growToWall(const HuVolume& volume, double wall_hu, InsideVolume& labels)
{
    const auto neighboursOf = [&](std::size_t n, std::vector<std::size_t>& next) {
        forEachOverFaces(labels.grid, n, [&](std::size_t m) {
            if (!labels.voxels[m] && volume.voxels[m] < wall_hu)
                next.push_back(m);
        });
    };
    const int slice_count = labels.grid.size[2];
    std::vector<std::vector<std::size_t>> slices(std::size_t(slice_count), std::vector<std::size_t>{});
    tbb::parallel_for(0, slice_count, [&](int k) {
        const std::size_t begin = labels.grid.offset({0, 0, k}), end = labels.grid.offset({0, 0, k + 1});
        const auto next = [&](std::size_t n) { return firstOther(labels.voxels.data(), n, end, kOutside); };
        for (std::size_t n = next(begin); n < end; n = next(n + 1))
            if (labels.voxels[n] == kGas)
                neighboursOf(n, slices[std::size_t(k)]);
    });
    std::vector<std::size_t> edge, next;
    for (auto& slice : slices)
        edge.insert(edge.end(), slice.begin(), slice.end());
    const int steps = std::max(1, int(kBlurredEdge_mm / labels.grid.spacing_mm[0]));
    for (int step = 0; step < steps && !edge.empty(); ++step) {
        next.clear();
        std::erase_if(edge, [&](std::size_t n) { return std::exchange(labels.voxels[n], std::uint8_t(kGas)) == kGas; });
        for (const std::size_t n : edge)
            neighboursOf(n, next);
        edge.swap(next);
    }
}

}  // namespace vicon::steps

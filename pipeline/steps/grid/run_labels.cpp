#include "grid/run_labels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "grid/byte_rows.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

void collectRuns(RunLabels& labels, const RowScanner& scan)
{
    const int ny = labels.size[1], nz = labels.size[2];
    std::vector<std::vector<VoxelRun>> slices(std::size_t(nz), std::vector<VoxelRun>{});
    labels.row_begin.assign(std::size_t(ny) * std::size_t(nz) + 1, 0);
    tbb::parallel_for(0, nz, [&](int k) {
        auto& runs = slices[std::size_t(k)];
        for (int j = 0; j < ny; ++j) {
            const std::size_t before = runs.size();
            scan(j, k, runs);
            labels.row_begin[labels.row(j, k) + 1] = runs.size() - before;
        }
        runs.shrink_to_fit();
    });
    std::partial_sum(labels.row_begin.begin(), labels.row_begin.end(), labels.row_begin.begin());
    labels.runs.reserve(labels.row_begin.back());
    for (auto& runs : slices) {
        labels.runs.insert(labels.runs.end(), runs.begin(), runs.end());
        runs = {};
    }
}

/// Joins the runs of two rows that overlap; with reach 1 also those that touch at a corner.
void joinRows(const RunLabels& labels, DisjointSets& sets, std::size_t row_a, std::size_t row_b, int reach)
{
    std::size_t a = labels.row_begin[row_a], b = labels.row_begin[row_b];
    const std::size_t a_end = labels.row_begin[row_a + 1], b_end = labels.row_begin[row_b + 1];
    while (a < a_end && b < b_end) {
        const VoxelRun &ra = labels.runs[a], &rb = labels.runs[b];
        if (ra.begin < rb.end + reach && rb.begin < ra.end + reach)
            sets.join(std::uint32_t(a), std::uint32_t(b));
        if (ra.end < rb.end)
            ++a;
        else
            ++b;
    }
}

void joinNeighbours(const RunLabels& labels, DisjointSets& sets, Neighbours neighbours)
{
    const int ny = labels.size[1], nz = labels.size[2];
    const bool all = neighbours == Neighbours::all;
    const int reach = all ? 1 : 0;
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j) {
            const std::size_t row = labels.row(j, k);
            if (j > 0)
                joinRows(labels, sets, row, row - 1, reach);
            if (k == 0)
                continue;
            const std::size_t below = row - std::size_t(ny);
            joinRows(labels, sets, row, below, reach);
            if (all && j > 0)
                joinRows(labels, sets, row, below - 1, reach);
            if (all && j + 1 < ny)
                joinRows(labels, sets, row, below + 1, reach);
        }
}

void addTo(RunComponent& component, const VoxelRun& run, int j, int k)
{
    const auto count = double(run.end - run.begin);
    component.voxels += std::size_t(run.end - run.begin);
    component.sum += run.sum;
    component.lower = {std::min(component.lower.i, run.begin), std::min(component.lower.j, j),
                       std::min(component.lower.k, k)};
    component.upper = {std::max(component.upper.i, run.end - 1), std::max(component.upper.j, j),
                       std::max(component.upper.k, k)};
    component.centre.i += count * 0.5 * (run.begin + run.end - 1);
    component.centre.j += count * j;
    component.centre.k += count * k;
}

void numberComponents(RunLabels& labels, DisjointSets& sets)
{
    constexpr auto kNone = ~std::uint32_t(0);  // not numbered yet
    std::vector<std::uint32_t> number(labels.runs.size(), kNone);
    for (int k = 0; k < labels.size[2]; ++k)
        for (int j = 0; j < labels.size[1]; ++j) {
            const std::size_t row = labels.row(j, k);
            for (std::size_t r = labels.row_begin[row]; r < labels.row_begin[row + 1]; ++r) {
                std::uint32_t& own = number[sets.rootOf(std::uint32_t(r))];
                if (own == kNone) {
                    own = std::uint32_t(labels.components.size());
                    labels.components.emplace_back();
                }
                labels.runs[r].label = own;
                addTo(labels.components[own], labels.runs[r], j, k);
            }
        }
    for (RunComponent& c : labels.components) {
        const auto count = double(c.voxels);
        c.centre = {c.centre.i / count, c.centre.j / count, c.centre.k / count};
    }
}

}  // namespace

int RunLabels::labelAt(Index3 v) const
{
    if (v.i < 0 || v.j < 0 || v.k < 0 || v.i >= size[0] || v.j >= size[1] || v.k >= size[2])
        return -1;
    const auto begin = runs.begin() + std::ptrdiff_t(row_begin[row(v.j, v.k)]);
    const auto end = runs.begin() + std::ptrdiff_t(row_begin[row(v.j, v.k) + 1]);
    const auto after = std::upper_bound(begin, end, v.i, [](int i, const VoxelRun& run) { return i < run.end; });
    return after != end && after->begin <= v.i ? int(after->label) : -1;
}

void RunLabels::forEachRun(const std::function<void(const VoxelRun&, int, int)>& use) const
{
    tbb::parallel_for(0, size[2], [&](int k) {
        for (int j = 0; j < size[1]; ++j)
            for (std::size_t r = row_begin[row(j, k)]; r < row_begin[row(j, k) + 1]; ++r)
                use(runs[r], j, k);
    });
}

RunLabels labelRuns(const std::array<int, 3>& size, const RowScanner& scan, Neighbours neighbours)
{
    RunLabels labels;
    labels.size = size;
    collectRuns(labels, scan);
    DisjointSets sets(labels.runs.size());
    joinNeighbours(labels, sets, neighbours);
    numberComponents(labels, sets);
    return labels;
}

RunLabels labelLumen(const InsideVolume& labels, Neighbours neighbours)
{
    const int nx = labels.grid.size[0];
    const auto scan = [&](int j, int k, std::vector<VoxelRun>& runs) {
        const std::uint8_t* row = &labels.voxels[labels.grid.offset({0, j, k})];
        for (int i = firstOther(row, 0, nx, kOutside); i < nx; i = firstOther(row, i + 1, nx, kOutside)) {
            if (row[i] != kGas && row[i] != kFluid)
                continue;
            const int begin = i;
            int fluid = 0;
            for (; i < nx && (row[i] == kGas || row[i] == kFluid); ++i)
                fluid += row[i] == kFluid ? 1 : 0;
            runs.push_back({begin, i, float(fluid), 0});
        }
    };
    return labelRuns(labels.grid.size, scan, neighbours);
}

std::vector<std::size_t> voxelsOf(const RunLabels& labels, std::uint32_t component, const Grid& grid)
{
    const RunComponent& box = labels.components[component];
    std::vector<std::size_t> voxels;
    for (int k = box.lower.k; k <= box.upper.k; ++k)
        for (int j = box.lower.j; j <= box.upper.j; ++j)
            for (std::size_t r = labels.row_begin[labels.row(j, k)]; r < labels.row_begin[labels.row(j, k) + 1]; ++r)
                if (const VoxelRun& run = labels.runs[r]; run.label == component)
                    for (int i = run.begin; i < run.end; ++i)
                        voxels.push_back(grid.offset({i, j, k}));
    return voxels;
}

}  // namespace vicon::steps

#include "grid/components.h"
#include "vicon/core/disjoint_sets.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace vicon::steps {
template <class AddRow>
void Components::addRows(AddRow addRow)
{
    const int ny = size_[1];
    std::vector<std::vector<Run>> slices(std::size_t(size_[2]), std::vector<Run>{});
    row_start_.assign(std::size_t(ny) * std::size_t(size_[2]) + 1, 0);
    tbb::parallel_for(0, size_[2], [&](int k) {
        auto& runs = slices[std::size_t(k)];
        for (int j = 0; j < ny; ++j) {
            const std::size_t before = runs.size();
            addRow(j, k, runs);
            row_start_[std::size_t(j) + std::size_t(ny) * std::size_t(k) + 1] = std::uint32_t(runs.size() - before);
        }
    });
    std::partial_sum(row_start_.begin(), row_start_.end(), row_start_.begin());
    runs_.reserve(row_start_.back());
    for (const auto& runs : slices)
        runs_.insert(runs_.end(), runs.begin(), runs.end());
    numberComponents();
}

Components::Components(const Grid& grid, const std::vector<std::uint16_t>& label) : size_(grid.size)
{
    addRows([&](int j, int k, std::vector<Run>& runs) {
        const std::uint16_t* row = label.data() + grid.offset({0, j, k});
        for (int i = 0; i < size_[0];) {
            const int begin = i;
            while (i < size_[0] && row[i] == row[begin])
                ++i;
            if (row[begin])
                runs.push_back({begin, i, j, k, row[begin], 0});
        }
    });
}

Components::Components(const InsideVolume& labels, std::uint8_t wanted) : size_(labels.grid.size)
{
    addRows([&](int j, int k, std::vector<Run>& runs) {
        const std::uint8_t* row = labels.voxels.data() + labels.grid.offset({0, j, k});
        const std::uint8_t* const end = row + size_[0];
        for (const std::uint8_t* at = std::find(row, end, wanted); at != end; at = std::find(at, end, wanted)) {
            const std::uint8_t* const begin = at;
            at = std::find_if(at, end, [wanted](std::uint8_t label) { return label != wanted; });
            runs.push_back({int(begin - row), int(at - row), j, k, 1, 0});
        }
    });
}

void Components::numberComponents()
{
    DisjointSets sets(runs_.size());
    forTouchingRuns([&](const Run& a, const Run& b) {
        if (a.label == b.label)
            sets.join(std::uint32_t(&a - runs_.data()), std::uint32_t(&b - runs_.data()));
    });
    for (std::uint32_t n = 0; n < runs_.size(); ++n) {
        const std::uint32_t root = sets.rootOf(n);
        runs_[n].component = root == n ? count_++ : runs_[root].component;
    }
}

std::uint32_t Components::at(Index3 v) const
{
    const Range r = row(v.j, v.k);
    const auto after = std::upper_bound(runs_.begin() + r.begin, runs_.begin() + r.end, v.i,
                                        [](int i, const Run& run) { return i < run.begin; });
    return (after - 1)->component;
}

}  // namespace vicon::steps

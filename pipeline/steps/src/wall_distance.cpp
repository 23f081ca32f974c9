#include "vicon/steps/wall_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace vicon::steps {
namespace {

/// Columns that are swept together: one cache line of floats, and whole vector registers.
constexpr int kLanes = 16;

using Lanes = std::array<float, kLanes>;

/// The squared distances of kLanes neighbouring columns, with a row of zeros (outside) before and behind.
class ColumnBlock {
public:
    explicit ColumnBlock(int rows) : rows_(rows), before_(std::size_t(rows) + 2), after_(std::size_t(rows)) {}

    /// Copies `lanes` columns in; false when none of them holds an inside voxel.
    bool load(const float* first, std::size_t row_stride, int lanes)
    {
        float any = 0;
        for (int r = 0; r < rows_; ++r) {
            Lanes& row = before_[std::size_t(r) + 1];
            row.fill(0);
            std::copy_n(first + std::size_t(r) * row_stride, lanes, row.begin());
            for (const float value : row)
                any = std::max(any, value);
        }
        return any > 0;
    }

    /// after[r] = min over q of before[q] + weight * (r - q)^2. The search of a row ends at the distance found so far,
    /// which is short in a lumen, and all columns search at once; it beats a lower envelope column by column there.
    void sweep(float weight)
    {
        for (int r = 0; r < rows_; ++r) {
            Lanes best = before_[std::size_t(r) + 1];
            float farthest = *std::max_element(best.begin(), best.end());
            for (int n = 1; farthest > weight * float(n) * float(n); ++n) {
                const float step = weight * float(n) * float(n);
                const Lanes& low = before_[std::size_t(std::max(r + 1 - n, 0))];
                const Lanes& high = before_[std::size_t(std::min(r + 1 + n, rows_ + 1))];
                for (int l = 0; l < kLanes; ++l)
                    best[std::size_t(l)] =
                        std::min(best[std::size_t(l)], std::min(low[std::size_t(l)], high[std::size_t(l)]) + step);
                if (n % 4 == 0)
                    farthest = *std::max_element(best.begin(), best.end());
            }
            after_[std::size_t(r)] = best;
        }
    }

    template <class Convert>
    void store(float* first, std::size_t row_stride, int lanes, Convert convert) const
    {
        for (int r = 0; r < rows_; ++r)
            for (int l = 0; l < lanes; ++l)
                first[std::size_t(r) * row_stride + std::size_t(l)] = convert(after_[std::size_t(r)][std::size_t(l)]);
    }

private:
    int rows_;
    std::vector<Lanes> before_, after_;
};

/// Squared distance, in voxels, to the nearest outside voxel of the same row; beyond the row is outside.
void sweepRow(const std::uint8_t* inside, float* squared, int count, float weight)
{
    for (int i = 0; i < count;) {
        if (!inside[i]) {
            ++i;
            continue;
        }
        int end = i;
        while (end < count && inside[end])
            ++end;
        for (int v = i; v < end; ++v) {
            const auto d = float(std::min(v - i + 1, end - v));
            squared[v] = weight * d * d;
        }
        i = end;
    }
}

}  // namespace

FieldVolume wallDistance(const InsideVolume& inside, Progress& progress)
{
    const Grid& grid = inside.grid;
    const auto [nx, ny, nz] = grid.size;
    const double unit_mm = *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end());
    // In units of the smallest spacing, so that on an isotropic grid all squares are whole numbers and exact.
    std::array<float, 3> weight;
    for (std::size_t d = 0; d < 3; ++d)
        weight[d] = float(std::pow(grid.spacing_mm[d] / unit_mm, 2));

    progress.report(0, "wall distance");
    FieldVolume field(grid);
    const std::size_t row = std::size_t(nx), slice = row * std::size_t(ny);
    tbb::parallel_for(tbb::blocked_range<int>(0, nz), [&, nx = nx, ny = ny](const tbb::blocked_range<int>& range) {
        ColumnBlock block(ny);
        for (int k = range.begin(); k < range.end(); ++k) {
            const std::size_t start = std::size_t(k) * slice;
            for (int j = 0; j < ny; ++j)
                sweepRow(&inside.voxels[start + std::size_t(j) * row], &field.voxels[start + std::size_t(j) * row], nx,
                         weight[0]);
            for (int i = 0; i < nx; i += kLanes) {
                const int lanes = std::min(kLanes, nx - i);
                float* first = &field.voxels[start + std::size_t(i)];
                if (!block.load(first, row, lanes))
                    continue;
                block.sweep(weight[1]);
                block.store(first, row, lanes, [](float v) { return v; });
            }
        }
    });
    progress.check();
    progress.report(0.6, "wall distance");
    const auto toMm = [unit_mm](float v) { return v > 0 ? float(unit_mm * (std::sqrt(double(v)) - 0.5)) : 0.0F; };
    tbb::parallel_for(tbb::blocked_range<int>(0, ny), [&, nx = nx, nz = nz](const tbb::blocked_range<int>& range) {
        ColumnBlock block(nz);
        for (int j = range.begin(); j < range.end(); ++j)
            for (int i = 0; i < nx; i += kLanes) {
                const int lanes = std::min(kLanes, nx - i);
                float* first = &field.voxels[std::size_t(j) * row + std::size_t(i)];
                if (!block.load(first, slice, lanes))
                    continue;
                block.sweep(weight[2]);
                block.store(first, slice, lanes, toMm);
            }
    });
    progress.check();
    progress.report(1, "wall distance");
    return field;
}

}  // namespace vicon::steps

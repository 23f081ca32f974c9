#include "grid/meniscus.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "grid/mask.h"

namespace vicon::steps {
namespace {

/// The gas voxels of a row that have fluid on one of their six sides.
std::vector<std::int32_t> contactsOf(const InsideVolume& labels, int j, int k)
{
    const Grid& grid = labels.grid;
    const auto nx = std::size_t(grid.size[0]);
    std::array<const std::uint8_t*, 5> rows{};
    bool fluid = false;
    for (std::size_t n = 0; n < 5; ++n) {
        const int dj = n == 1 ? -1 : n == 2 ? 1 : 0, dk = n == 3 ? -1 : n == 4 ? 1 : 0;
        if (const Index3 v{0, j + dj, k + dk}; grid.contains(v)) {
            rows[n] = &labels.voxels[grid.offset(v)];
            fluid = fluid || std::memchr(rows[n], kFluid, nx) != nullptr;
        }
    }
    std::vector<std::int32_t> found;
    if (!fluid || !std::memchr(rows[0], kGas, nx))
        return found;
    for (std::size_t i = 0; i < nx; ++i) {
        if (rows[0][i] != kGas)
            continue;
        bool touches = (i > 0 && rows[0][i - 1] == kFluid) || (i + 1 < nx && rows[0][i + 1] == kFluid);
        for (std::size_t n = 1; n < 5; ++n)
            touches = touches || (rows[n] && rows[n][i] == kFluid);
        if (touches)
            found.push_back(std::int32_t(i));
    }
    return found;
}

/// What a voxel becomes when its binomial neighbourhood decides.
std::uint8_t smoothedLabel(const InsideVolume& labels, Index3 v)
{
    int gas = 0, fluid = 0;
    for (int k = -2; k <= 2; ++k)
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i) {
                const std::uint8_t label = labels.valueOr({v.i + i, v.j + j, v.k + k}, kOutside);
                const int weight = binomial(i) * binomial(j) * binomial(k);
                gas += label == kGas ? weight : 0;
                fluid += label == kFluid ? weight : 0;
            }
    const std::uint8_t own = labels.at(v);
    if (2 * (gas + fluid) == kBinomialSum || (2 * (gas + fluid) > kBinomialSum) == (own != kOutside))
        return own;
    return own != kOutside ? kOutside : gas > fluid ? kGas : kFluid;
}

}  // namespace

Meniscus::Meniscus(const InsideVolume& labels) : grid_(labels.grid)
{
    const auto [nx, ny, nz] = grid_.size;
    std::vector<std::vector<std::int32_t>> rows(std::size_t(ny) * std::size_t(nz), std::vector<std::int32_t>{});
    tbb::parallel_for(0, nz, [&, ny = ny](int k) {
        for (int j = 0; j < ny; ++j)
            rows[std::size_t(j) + std::size_t(ny) * std::size_t(k)] = contactsOf(labels, j, k);
    });
    row_begin_.reserve(rows.size() + 1);
    row_near_.assign(rows.size(), 0);
    for (std::size_t row = 0; row < rows.size(); ++row) {
        row_begin_.push_back(std::uint32_t(columns_.size()));
        columns_.insert(columns_.end(), rows[row].begin(), rows[row].end());
        if (rows[row].empty())
            continue;
        const int j = int(row) % ny, k = int(row) / ny;
        for (int dk = -kReach_voxels; dk <= kReach_voxels; ++dk)
            for (int dj = -kReach_voxels; dj <= kReach_voxels; ++dj)
                if (grid_.contains({0, j + dj, k + dk}))
                    row_near_[std::size_t(j + dj) + std::size_t(ny) * std::size_t(k + dk)] = 1;
    }
    row_begin_.push_back(std::uint32_t(columns_.size()));
}

bool Meniscus::near(Index3 v) const
{
    const int ny = grid_.size[1];
    if (!grid_.contains({0, v.j, v.k}) || !row_near_[std::size_t(v.j) + std::size_t(ny) * std::size_t(v.k)])
        return false;
    for (int dk = -kReach_voxels; dk <= kReach_voxels; ++dk)
        for (int dj = -kReach_voxels; dj <= kReach_voxels; ++dj) {
            if (!grid_.contains({0, v.j + dj, v.k + dk}))
                continue;
            const std::size_t row = std::size_t(v.j + dj) + std::size_t(ny) * std::size_t(v.k + dk);
            const auto end = columns_.begin() + row_begin_[row + 1];
            const auto at = std::lower_bound(columns_.begin() + row_begin_[row], end, v.i - kReach_voxels);
            if (at != end && *at <= v.i + kReach_voxels)
                return true;
        }
    return false;
}

std::vector<std::size_t> Meniscus::wallNear(const InsideVolume& labels) const
{
    const auto [nx, ny, nz] = grid_.size;
    std::vector<std::vector<std::size_t>> slices(std::size_t(nz), std::vector<std::size_t>{});
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        std::vector<std::uint8_t> marked(static_cast<std::size_t>(nx));
        for (int j = 0; j < ny; ++j) {
            if (!row_near_[std::size_t(j) + std::size_t(ny) * std::size_t(k)])
                continue;
            markRow(j, k, marked);
            for (int i = 0; i < nx; ++i)
                if (marked[std::size_t(i)] && besideOther(labels, {i, j, k}))
                    slices[std::size_t(k)].push_back(grid_.offset({i, j, k}));
        }
    });
    std::vector<std::size_t> all;
    for (const auto& slice : slices)
        all.insert(all.end(), slice.begin(), slice.end());
    return all;
}

void Meniscus::markRow(int j, int k, std::vector<std::uint8_t>& marked) const
{
    std::fill(marked.begin(), marked.end(), std::uint8_t(0));
    for (int dk = -kReach_voxels; dk <= kReach_voxels; ++dk)
        for (int dj = -kReach_voxels; dj <= kReach_voxels; ++dj) {
            if (!grid_.contains({0, j + dj, k + dk}))
                continue;
            const std::size_t row = std::size_t(j + dj) + std::size_t(grid_.size[1]) * std::size_t(k + dk);
            for (std::uint32_t n = row_begin_[row]; n < row_begin_[row + 1]; ++n)
                for (int i = std::max(0, columns_[n] - kReach_voxels);
                     i <= std::min(grid_.size[0] - 1, columns_[n] + kReach_voxels); ++i)
                    marked[std::size_t(i)] = 1;
        }
}

void smoothAtMeniscus(InsideVolume& labels)
{
    const std::vector<std::size_t> voxels = Meniscus(labels).wallNear(labels);
    std::vector<std::uint8_t> becomes(voxels.size());
    tbb::parallel_for(std::size_t(0), voxels.size() / 1024 + 1, [&](std::size_t chunk) {
        for (std::size_t n = chunk * 1024; n < std::min(voxels.size(), (chunk + 1) * 1024); ++n)
            becomes[n] = smoothedLabel(labels, labels.grid.indexOf(voxels[n]));
    });
    for (std::size_t n = 0; n < voxels.size(); ++n)
        labels.voxels[voxels[n]] = becomes[n];
}

}  // namespace vicon::steps

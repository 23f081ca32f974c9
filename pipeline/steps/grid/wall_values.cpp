#include "grid/wall_values.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "grid/allocate.h"

namespace vicon::steps {
namespace {

/// Which voxels of a row lie beside the wall, row by row, with one voxel more at both ends.
class BesideWall {
public:
    explicit BesideWall(const InsideVolume& inside)
        : inside_(inside), width_(std::size_t(inside.grid.size[0]) + 2), marks_(width_)
    {
        for (auto& row : rows_)
            row.resize(width_ + 2);
    }

    /// Element n tells of voxel n - 1, from one before the first to one behind the last.
    const std::vector<std::uint8_t>& of(int j, int k)
    {
        load(rows_[0], j, k);
        load(rows_[1], j - 1, k);
        load(rows_[2], j + 1, k);
        load(rows_[3], j, k - 1);
        load(rows_[4], j, k + 1);
        const std::uint8_t *own = &rows_[0][1], *below = &rows_[1][1], *above = &rows_[2][1], *before = &rows_[3][1],
                           *behind = &rows_[4][1];
        for (std::size_t i = 0; i < width_; ++i) {
            const std::uint8_t here = own[i];
            const auto differs = [here](std::uint8_t other) { return std::uint8_t(other ^ here); };
            marks_[i] = differs(rows_[0][i]) | differs(own[i + 1]) | differs(below[i]) | differs(above[i]) |
                        differs(before[i]) | differs(behind[i]);
        }
        return marks_;
    }

private:
    /// 1 inside, 0 outside and beyond the grid; element i + 2 is voxel i.
    void load(std::vector<std::uint8_t>& row, int j, int k) const
    {
        std::fill(row.begin(), row.end(), std::uint8_t(0));
        if (!inside_.grid.contains({0, j, k}))
            return;
        const std::uint8_t* from = &inside_.at({0, j, k});
        std::transform(from, from + inside_.grid.size[0], row.begin() + 2,
                       [](std::uint8_t label) { return std::uint8_t(label != kOutside); });
    }

    const InsideVolume& inside_;
    std::size_t width_;
    std::array<std::vector<std::uint8_t>, 5> rows_;
    std::vector<std::uint8_t> marks_;
};

/// Distance in voxels of the smallest spacing; `steps` are the offsets of the neighbours along the axes, `lengths`
/// their distances.
float distanceFromWall(const std::int16_t* value, const std::array<std::ptrdiff_t, 3>& steps,
                       const std::array<float, 3>& lengths)
{
    const float here = *value, towards = here < 0 ? 1 : -1;
    float slope2 = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        const float steepest =
            std::max({(float(value[steps[d]]) - here) * towards, (float(value[-steps[d]]) - here) * towards, 0.0F}) /
            lengths[d];
        slope2 += steepest * steepest;
    }
    return std::abs(here) / std::sqrt(slope2);
}

}  // namespace

Volume<std::int16_t> wallValues(const WallField& field, const InsideVolume& inside)
{
    const auto [nx, ny, nz] = inside.grid.size;
    auto values = makeVolume<std::int16_t>(Grid{.size = {nx + 2, ny + 2, nz + 2}}, std::int16_t(kWallScale));
    const RowsNearLumen rows(inside);
    tbb::parallel_for(tbb::blocked_range<int>(-1, nz + 1), [&, nx = nx, ny = ny](const tbb::blocked_range<int>& range) {
        BesideWall beside(inside);
        for (int k = range.begin(); k < range.end(); ++k)
            for (int j = -1; j <= ny; ++j) {
                if (!rows.near(j, k))
                    continue;
                const std::vector<std::uint8_t>& marks = beside.of(j, k);
                std::int16_t* row = &values.at({0, j + 1, k + 1});
                for (int n = 0; n < nx + 2; ++n) {
                    const Index3 v{n - 1, j, k};
                    const bool is_inside = inside.valueOr(v, kOutside) != kOutside;
                    if (marks[std::size_t(n)])
                        row[n] = std::int16_t(
                            std::lround((is_inside ? field.ofInside(v) : field.ofOutside(v)) * kWallScale));
                    else if (is_inside)
                        row[n] = std::int16_t(-kWallScale);
                }
            }
    });
    return values;
}

std::vector<NearWall> findNearWall(const Volume<std::int16_t>& values, const InsideVolume& inside)
{
    const Grid& grid = inside.grid;
    const auto [nx, ny, nz] = grid.size;
    const std::array<std::ptrdiff_t, 3> steps{1, nx + 2, std::ptrdiff_t(nx + 2) * (ny + 2)};
    const double unit_mm = *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end());
    std::array<float, 3> lengths;
    std::transform(grid.spacing_mm.begin(), grid.spacing_mm.end(), lengths.begin(),
                   [&](double spacing_mm) { return float(spacing_mm / unit_mm); });
    std::vector<std::vector<NearWall>> slices(std::size_t(nz), std::vector<NearWall>{});
    const RowsNearLumen rows(inside);
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        BesideWall beside(inside);
        for (int j = 0; j < ny; ++j) {
            if (!rows.near(j, k))
                continue;
            const std::vector<std::uint8_t>& marks = beside.of(j, k);
            for (int n = 1; n <= nx; ++n)
                if (marks[std::size_t(n)])
                    slices[std::size_t(k)].push_back(
                        {grid.offset({n - 1, j, k}), distanceFromWall(&values.at({n, j + 1, k + 1}), steps, lengths)});
        }
    });
    std::vector<NearWall> all;
    for (const auto& slice : slices)
        all.insert(all.end(), slice.begin(), slice.end());
    return all;
}

}  // namespace vicon::steps

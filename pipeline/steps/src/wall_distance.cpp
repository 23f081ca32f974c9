#include "vicon/steps/wall_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "allocate.h"
#include "distance_sweep.h"
#include "wall_field.h"

namespace vicon::steps {
namespace {

/// The least distance of an inside voxel from the wall, in voxels.
constexpr double kLeastDistance = 0.05;

template <bool kPlaces>
void sweepAll(const InsideVolume& inside, const Swept& swept, const std::array<float, 3>& weight)
{
    const auto [nx, ny, nz] = swept.grid.size;
    const std::size_t row = std::size_t(nx), slice = row * std::size_t(ny);
    const auto sweepColumns = [nx = nx, &swept](ColumnBlock<kPlaces>& block, std::size_t start, std::size_t stride,
                                                float w) {
        for (int i = 0; i < nx; i += kLanes) {
            const int lanes = std::min(kLanes, nx - i);
            if (!block.load(swept, start + std::size_t(i), stride, lanes))
                continue;
            block.sweep(w);
            block.store(swept, start + std::size_t(i), stride, lanes);
        }
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, nz), [&, nx = nx, ny = ny](const tbb::blocked_range<int>& range) {
        ColumnBlock<kPlaces> block(ny);
        for (int k = range.begin(); k < range.end(); ++k) {
            const std::size_t start = std::size_t(k) * slice;
            for (std::size_t n = start; n < start + slice; n += row)
                sweepRow(&inside.voxels[n], swept.squared + n, kPlaces ? swept.place + n : nullptr, nx, weight[0]);
            sweepColumns(block, start, row, weight[1]);
        }
    });
    tbb::parallel_for(tbb::blocked_range<int>(0, ny), [&, nz = nz](const tbb::blocked_range<int>& range) {
        ColumnBlock<kPlaces> block(nz);
        for (int j = range.begin(); j < range.end(); ++j)
            sweepColumns(block, std::size_t(j) * row, slice, weight[2]);
    });
}

double unitOf(const Grid& grid)
{
    return *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end());
}

/// Squares of the spacings in units of the smallest, so that on an isotropic grid all squares are whole and exact.
std::array<float, 3> weightsOf(const Grid& grid)
{
    std::array<float, 3> weight;
    for (std::size_t d = 0; d < 3; ++d)
        weight[d] = float(std::pow(grid.spacing_mm[d] / unitOf(grid), 2));
    return weight;
}

template <class Convert>
void convertInside(FieldVolume& field, const InsideVolume& inside, Convert convert)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, field.voxels.size(), 1 << 16), [&](const auto& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n)
            if (inside.voxels[n])
                field.voxels[n] = convert(n);
    });
}

/// Distance in voxels between a voxel beside the wall and the wall: the wall field there over its slope towards the
/// other side, steepest along each axis.
double distanceToWall(const WallField& wall, const InsideVolume& inside, Index3 v)
{
    const Grid& grid = inside.grid;
    const double unit = unitOf(grid);
    const auto valueAt = [&](Index3 n) {
        return double(inside.valueOr(n, kOutside) ? wall.ofInside(n) : wall.ofOutside(n));
    };
    const double here = valueAt(v), towards = here < 0 ? 1 : -1;
    double slope2 = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        double steepest = 0;
        for (const int step : {-1, 1}) {
            Index3 n = v;
            (d == 0 ? n.i : d == 1 ? n.j : n.k) += step;
            steepest = std::max(steepest, (valueAt(n) - here) * towards * unit / grid.spacing_mm[d]);
        }
        slope2 += steepest * steepest;
    }
    return slope2 > 0 ? std::abs(here) / std::sqrt(slope2) : 0;
}

/// Where the wall lies before each outside voxel beside an inside one.
std::vector<std::uint8_t> placesOf(const WallField& wall, const InsideVolume& inside)
{
    const Grid& grid = inside.grid;
    std::vector<std::uint8_t> places(inside.voxels.size(), kHalfVoxel);
    const RowsNearLumen rows(inside);
    tbb::parallel_for(tbb::blocked_range<int>(0, grid.size[2]), [&](const tbb::blocked_range<int>& range) {
        for (int k = range.begin(); k < range.end(); ++k)
            for (int j = 0; j < grid.size[1]; ++j)
                for (int i = 0; i < grid.size[0] && rows.near(j, k); ++i)
                    if (const Index3 v{i, j, k}; !inside.at(v) && besideOther(inside, v)) {
                        const double voxels = distanceToWall(wall, inside, v);
                        places[grid.offset(v)] =
                            std::uint8_t(std::lround(std::min(float(voxels), kLargestPlace) / kPlaceUnit));
                    }
    });
    return places;
}

}  // namespace

FieldVolume wallDistance(const InsideVolume& inside, Progress& progress)
{
    progress.report(0, "wall distance");
    auto field = makeVolume<float>(inside.grid);
    sweepAll<false>(inside, {inside.grid, field.voxels.data(), nullptr}, weightsOf(inside.grid));
    progress.check();
    convertInside(field, inside, [&, unit_mm = unitOf(inside.grid)](std::size_t n) {
        return float(unit_mm * (std::sqrt(double(field.voxels[n])) - 0.5));
    });
    progress.report(1, "wall distance");
    return field;
}

FieldVolume wallDistance(const InsideVolume& inside, const HuVolume& hu, Progress& progress)
{
    progress.report(0, "wall distance");
    const WallField wall(hu, inside, {});
    auto places = placesOf(wall, inside);
    progress.check();
    progress.report(0.3, "wall distance");
    auto field = makeVolume<float>(inside.grid);
    sweepAll<true>(inside, {inside.grid, field.voxels.data(), places.data()}, weightsOf(inside.grid));
    progress.check();
    const double unit_mm = unitOf(inside.grid);
    convertInside(field, inside, [&](std::size_t n) {
        double voxels = std::sqrt(double(field.voxels[n])) - double(places[n]) * double(kPlaceUnit);
        // Beside the wall the field itself tells the distance, better than the way to a voxel's centre.
        if (const Index3 v = inside.grid.indexOf(n); field.voxels[n] < 1.5F)
            if (const double slope = distanceToWall(wall, inside, v); slope > 0)
                voxels = slope;
        return float(unit_mm * std::max(voxels, kLeastDistance));
    });
    progress.report(1, "wall distance");
    return field;
}

}  // namespace vicon::steps

#include "vicon/steps/wall_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "grid/allocate.h"
#include "grid/distance_sweep.h"
#include "grid/wall_values.h"
#include "vicon/core/fresh_memory.h"

namespace vicon::steps {
namespace {

/// The least distance of an inside voxel from the wall, in voxels: more than 0, which is outside.
constexpr float kLeastDistance = 0.05F;

/// Calls visit(first, last) for each run of rows with an inside voxel among `count`.
template <class AnyInside, class Visit>
void forRuns(int count, AnyInside anyInside, Visit visit)
{
    for (int first = 0; first < count;) {
        if (!anyInside(first)) {
            ++first;
            continue;
        }
        int last = first;
        while (last + 1 < count && anyInside(last + 1))
            ++last;
        visit(first, last);
        first = last + 1;
    }
}

/// Squared distances along rows, then columns, then across slices; in the end distance(squared, place in voxels) of
/// every inside voxel.
template <bool kPlaces, class Distance>
void sweepAll(const InsideVolume& inside, const Swept& swept, const std::array<float, 3>& weight, Distance distance)
{
    using Block = ColumnBlock<kPlaces>;
    const auto [nx, ny, nz] = swept.grid.size;
    const std::size_t row = std::size_t(nx), slice = row * std::size_t(ny);
    Occupied occupied(swept.grid);
    const auto partOf = [nx = nx](int stretch, int first, int last, int count, std::size_t start, std::size_t stride) {
        const int i = stretch * kLanes;
        return typename Block::Part{start + std::size_t(i) + std::size_t(first) * stride,
                                    stride,
                                    last - first + 1,
                                    std::min(kLanes, nx - i),
                                    first == 0,
                                    last == count - 1};
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, nz), [&, nx = nx, ny = ny](const tbb::blocked_range<int>& range) {
        Block block(ny);
        for (int k = range.begin(); k < range.end(); ++k) {
            const std::size_t start = std::size_t(k) * slice;
            for (int j = 0; j < ny; ++j) {
                const std::size_t n = start + std::size_t(j) * row;
                sweepRow(&inside.voxels[n], swept.squared + n, kPlaces ? swept.place + n : nullptr, nx, weight[0],
                         &occupied.at(0, j, k));
            }
            for (int stretch = 0; stretch < occupied.stretches(); ++stretch)
                forRuns(
                    ny, [&](int j) { return occupied.at(stretch, j, k) != 0; },
                    [&](int first, int last) {
                        const auto part = partOf(stretch, first, last, ny, start, row);
                        block.load(swept, part);
                        block.sweep(weight[1]);
                        block.store(swept, part);
                    });
        }
    });
    tbb::parallel_for(tbb::blocked_range<int>(0, ny), [&, nz = nz](const tbb::blocked_range<int>& range) {
        Block block(nz);
        for (int j = range.begin(); j < range.end(); ++j)
            for (int stretch = 0; stretch < occupied.stretches(); ++stretch)
                forRuns(
                    nz, [&](int k) { return occupied.at(stretch, j, k) != 0; },
                    [&](int first, int last) {
                        const auto part = partOf(stretch, first, last, nz, std::size_t(j) * row, slice);
                        block.load(swept, part);
                        block.sweep(weight[2]);
                        block.store(swept, part, distance);
                    });
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

/// Where the wall lies before each outside voxel, in 128ths of a voxel: nowhere, unless an inside voxel is beside it.
std::vector<std::uint8_t> placesOf(const std::vector<NearWall>& wall, const InsideVolume& inside)
{
    std::vector<std::uint8_t> places;
    fillFresh(places, inside.voxels.size(), std::uint8_t(0));
    for (const NearWall& near : wall)
        places[near.offset] = std::uint8_t(std::lround(std::min(near.voxels, kLargestPlace) / kPlaceUnit));
    return places;
}

}  // namespace

FieldVolume wallDistance(const InsideVolume& inside, Progress& progress)
{
    progress.report(0, "wall distance");
    auto field = makeVolume<float>(inside.grid);
    sweepAll<false>(inside, {inside.grid, field.voxels.data(), nullptr}, weightsOf(inside.grid),
                    [unit_mm = unitOf(inside.grid)](float squared, float) {
                        return float(unit_mm * (std::sqrt(double(squared)) - 0.5));
                    });
    progress.check();
    progress.report(1, "wall distance");
    return field;
}

FieldVolume wallDistance(const InsideVolume& inside, const std::vector<NearWall>& wall, Progress& progress)
{
    progress.report(0, "wall distance");
    auto places = placesOf(wall, inside);
    auto field = makeVolume<float>(inside.grid);
    const auto unit_mm = float(unitOf(inside.grid));
    sweepAll<true>(inside, {inside.grid, field.voxels.data(), places.data()}, weightsOf(inside.grid),
                   [unit_mm](float squared, float place) {
                       return unit_mm * std::max(std::sqrt(squared) - place, kLeastDistance);
                   });
    progress.check();
    // Beside the wall the field itself tells the distance, better than the way to a voxel's centre.
    for (const NearWall& near : wall)
        if (inside.voxels[near.offset])
            field.voxels[near.offset] = unit_mm * std::max(near.voxels, kLeastDistance);
    progress.report(1, "wall distance");
    return field;
}

FieldVolume wallDistance(const InsideVolume& inside, const HuVolume& hu, Progress& progress,
                         const WallDensities& densities)
{
    const WallField field(hu, inside, densities);
    return wallDistance(inside, findNearWall(wallValues(field, inside), inside), progress);
}

}  // namespace vicon::steps

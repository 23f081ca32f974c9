#include "vicon/viewer/model/slice_slab.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vicon::viewer {
namespace {

constexpr int kSlabRows = 16;  // copied at a time: their planes fit into the nearest cache

Grid gridOf(const Grid& from, int first, int planes)
{
    Grid grid;
    grid.size = {from.size[1], from.size[2], planes};
    grid.axis = {from.axis[1], from.axis[2], from.axis[0]};
    grid.spacing_mm = {from.spacing_mm[1], from.spacing_mm[2], from.spacing_mm[0]};
    grid.origin_mm = from.pointAt(Index3{first, 0, 0});
    return grid;
}

/// Rows `begin` to `end` of a slice of the volume.
void copyRows(const HuView& from, HuVolume& to, int first, int k, int begin, int end)
{
    const int planes = to.grid.size[2], rows = end - begin;
    std::array<std::array<std::int16_t, kSlabRows>, SliceSlab::kPlanes> turned;
    for (int j = 0; j < rows; ++j) {
        const std::int16_t* row = &from.at({first, begin + j, k});
        for (int i = 0; i < planes; ++i)
            turned[std::size_t(i)][std::size_t(j)] = row[i];
    }
    for (int i = 0; i < planes; ++i)
        std::copy_n(turned[std::size_t(i)].begin(), rows, &to.at({begin, k, i}));
}

}  // namespace

SliceSlab::SliceSlab(const HuView& volume, double plane, const Progress* wanted)
{
    const auto& size = volume.grid.size;
    const int planes = std::min(kPlanes, size[0]);
    first_ = std::clamp(int(std::floor(plane)) - planes / 2, 0, size[0] - planes);
    at_begin_ = first_ == 0;
    at_end_ = first_ + planes == size[0];
    volume_ = HuVolume(gridOf(volume.grid, first_, planes));
    for (int k = 0; k < size[2]; ++k) {
        if (wanted)
            wanted->check();
        for (int j = 0; j < size[1]; j += kSlabRows)
            copyRows(volume, volume_, first_, k, j, std::min(j + kSlabRows, size[1]));
    }
}

std::optional<double> SliceSlab::planeOf(const Grid& grid, const PlaneView& view)
{
    constexpr double kSame = 1e-9;
    if (std::abs(std::abs(dot(view.forward(), grid.axis[0])) - 1) > kSame)
        return std::nullopt;
    return grid.continuousIndexAt(view.centre_mm).i;
}

bool SliceSlab::holds(double plane) const
{
    return (at_begin_ || plane >= first_) && (at_end_ || plane <= first_ + volume_.grid.size[2] - 1);
}

}  // namespace vicon::viewer

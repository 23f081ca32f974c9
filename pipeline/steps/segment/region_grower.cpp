#include "segment/region_grower.h"

#include <itkConnectedThresholdImageFilter.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "grid/allocate.h"
#include "grid/itk_view.h"
#include "grid/voxel_box.h"
#include "vicon/core/nearest_voxel.h"

namespace vicon::steps {
namespace {

/// No scan measures it: the density of what must not be grown into.
constexpr std::int16_t kBarrier_hu = std::numeric_limits<std::int16_t>::max();

VoxelBox bodyBox(const Body& body, const Grid& grid)
{
    VoxelBox coarse;
    for (std::size_t n = 0; n < body.inside.voxels.size(); ++n)
        if (body.inside.voxels[n])
            coarse.take(body.inside.grid.indexOf(n));
    const int f = body.factor;
    const auto end = [&](int high, std::size_t axis) { return std::min(grid.size[axis], high * f); };
    return {{coarse.low.i * f, coarse.low.j * f, coarse.low.k * f},
            {end(coarse.high.i, 0), end(coarse.high.j, 1), end(coarse.high.k, 2)}};
}

std::int16_t clampedHu(double hu)
{
    return std::int16_t(std::clamp(hu, double(std::numeric_limits<std::int16_t>::min()), double(kBarrier_hu - 1)));
}

/// Where a mask's voxels lie, slice by slice, and how many there are.
struct Extent {
    VoxelBox box;
    std::size_t voxels = 0;
};

Extent extentOf(const std::uint8_t* mask, const Grid& grid)
{
    const auto row = std::size_t(grid.size[0]);
    std::vector<Extent> slices(std::size_t(grid.size[2]), Extent{});
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        Extent& slice = slices[std::size_t(k)];
        for (int j = 0; j < grid.size[1]; ++j) {
            const std::uint8_t* const begin = mask + grid.offset({0, j, k});
            const auto count = std::size_t(std::count(begin, begin + row, std::uint8_t(kGas)));
            if (count == 0)
                continue;
            const auto first = std::find(begin, begin + row, std::uint8_t(kGas));
            const auto last = std::find(std::reverse_iterator(begin + row), std::reverse_iterator(begin), kGas);
            slice.box.take(Index3{int(first - begin), j, k});
            slice.box.take(Index3{int(last.base() - begin) - 1, j, k});
            slice.voxels += count;
        }
    });
    Extent whole;
    for (const Extent& slice : slices) {
        whole.box.takeAll(slice.box);
        whole.voxels += slice.voxels;
    }
    return whole;
}

}  // namespace

struct RegionGrower::Filter {
    using Itk = itk::ConnectedThresholdImageFilter<ItkHu, ItkMask>;
    Itk::Pointer itk = Itk::New();
};

RegionGrower::RegionGrower(const HuVolume& volume, const Body& body, Padding padding)
    : grid_(volume.grid), filter_(std::make_unique<Filter>())
{
    const VoxelBox box = bodyBox(body, grid_);
    begin_ = box.low;
    box_ = makeVolume<std::int16_t>(cropped(grid_, box));
    tbb::parallel_for(0, box_.grid.size[2], [&](int k) {
        for (int j = 0; j < box_.grid.size[1]; ++j) {
            const std::int16_t* from = &volume.at({begin_.i, begin_.j + j, begin_.k + k});
            std::int16_t* to = &box_.at({0, j, k});
            for (int i = 0; i < box_.grid.size[0]; ++i) {
                const bool grows = body.holds(begin_.j + j, begin_.k + k, (begin_.i + i) / body.factor) &&
                                   (padding == Padding::counts || from[i] != kPaddingHu);
                to[i] = grows ? from[i] : kBarrier_hu;
            }
        }
    });
    filter_->itk->SetInput(itkView(box_.voxels.data(), box_.grid.size));
    filter_->itk->SetReplaceValue(kGas);
}

RegionGrower::~RegionGrower() = default;

std::optional<Index3> RegionGrower::seedAt(Point3 point, double within_mm, double low_hu, double high_hu) const
{
    const auto found = nearestVoxel(grid_, point, within_mm, [&](Index3 v) {
        const int hu = box_.valueOr({v.i - begin_.i, v.j - begin_.j, v.k - begin_.k}, kBarrier_hu);
        return hu != kBarrier_hu && hu >= low_hu && hu <= high_hu;
    });
    return found ? std::optional(found->voxel) : std::nullopt;
}

GrownRegion RegionGrower::grow(Index3 seed, double low_hu, double high_hu, int margin)
{
    auto& filter = *filter_->itk;
    filter.SetLower(clampedHu(std::ceil(low_hu)));
    filter.SetUpper(clampedHu(std::floor(high_hu)));
    filter.SetSeed({seed.i - begin_.i, seed.j - begin_.j, seed.k - begin_.k});
    filter.Update();
    const std::uint8_t* const found = filter.GetOutput()->GetBufferPointer();
    Extent extent = extentOf(found, box_.grid);
    GrownRegion region{{}, extent.voxels};
    if (region.voxels == 0)
        return region;
    const auto inScan = [&](Index3 v) { return Index3{v.i + begin_.i, v.j + begin_.j, v.k + begin_.k}; };
    const VoxelBox box{inScan(extent.box.low), inScan(extent.box.high)};
    region.mask = makeVolume<std::uint8_t>(cropped(grid_, box.grown(margin, grid_)));
    const Index3 to = region.mask.grid.indexAt(grid_.pointAt(box.low));
    const int columns = box.high.i - box.low.i;
    for (int k = 0; k < box.high.k - box.low.k; ++k)
        for (int j = 0; j < box.high.j - box.low.j; ++j) {
            const Index3 row{extent.box.low.i, extent.box.low.j + j, extent.box.low.k + k};
            std::copy_n(found + box_.grid.offset(row), columns, &region.mask.at({to.i, to.j + j, to.k + k}));
        }
    return region;
}

}  // namespace vicon::steps

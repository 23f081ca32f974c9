#include "segment/region_grower.h"

#include <itkConnectedThresholdImageFilter.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "grid/allocate.h"
#include "grid/itk_view.h"
#include "vicon/core/nearest_voxel.h"

namespace vicon::steps {
namespace {

/// No scan measures it: the density of what must not be grown into.
constexpr std::int16_t kBarrier_hu = std::numeric_limits<std::int16_t>::max();

/// Both ends included.
struct Box {
    Index3 lower{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
    Index3 upper{-1, -1, -1};

    void add(Index3 v)
    {
        lower = {std::min(lower.i, v.i), std::min(lower.j, v.j), std::min(lower.k, v.k)};
        upper = {std::max(upper.i, v.i), std::max(upper.j, v.j), std::max(upper.k, v.k)};
    }
    void add(const Box& other)
    {
        if (other.upper.i < 0)
            return;
        add(other.lower);
        add(other.upper);
    }
};

/// The part of a grid within a box and a margin around it.
Grid cropped(const Grid& grid, const Box& box, int margin)
{
    const std::array<int, 3> lower{box.lower.i, box.lower.j, box.lower.k}, upper{box.upper.i, box.upper.j, box.upper.k};
    std::array<int, 3> from{};
    Grid crop = grid;
    for (std::size_t a = 0; a < 3; ++a) {
        from[a] = std::max(0, lower[a] - margin);
        crop.size[a] = std::min(grid.size[a], upper[a] + margin + 1) - from[a];
    }
    crop.origin_mm = grid.pointAt(Index3{from[0], from[1], from[2]});
    return crop;
}

Box bodyBox(const Body& body, const Grid& grid)
{
    Box coarse;
    for (std::size_t n = 0; n < body.inside.voxels.size(); ++n)
        if (body.inside.voxels[n])
            coarse.add(body.inside.grid.indexOf(n));
    const int f = body.factor;
    const auto last = [&](int upper, std::size_t axis) { return std::min(grid.size[axis], (upper + 1) * f) - 1; };
    return {{coarse.lower.i * f, coarse.lower.j * f, coarse.lower.k * f},
            {last(coarse.upper.i, 0), last(coarse.upper.j, 1), last(coarse.upper.k, 2)}};
}

std::int16_t clampedHu(double hu)
{
    return std::int16_t(std::clamp(hu, double(std::numeric_limits<std::int16_t>::min()), double(kBarrier_hu - 1)));
}

/// Where a mask's voxels lie, slice by slice, and how many there are.
struct Extent {
    Box box;
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
            slice.box.add(Index3{int(first - begin), j, k});
            slice.box.add(Index3{int(last.base() - begin) - 1, j, k});
            slice.voxels += count;
        }
    });
    Extent whole;
    for (const Extent& slice : slices) {
        whole.box.add(slice.box);
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
    const Box box = bodyBox(body, grid_);
    begin_ = box.lower;
    box_ = makeVolume<std::int16_t>(cropped(grid_, box, 0));
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
    const Box box{inScan(extent.box.lower), inScan(extent.box.upper)};
    region.mask = makeVolume<std::uint8_t>(cropped(grid_, box, margin));
    const Index3 to = region.mask.grid.indexAt(grid_.pointAt(box.lower));
    const int columns = box.upper.i - box.lower.i + 1;
    for (int k = 0; k <= box.upper.k - box.lower.k; ++k)
        for (int j = 0; j <= box.upper.j - box.lower.j; ++j) {
            const Index3 row{extent.box.lower.i, extent.box.lower.j + j, extent.box.lower.k + k};
            std::copy_n(found + box_.grid.offset(row), columns, &region.mask.at({to.i, to.j + j, to.k + k}));
        }
    return region;
}

}  // namespace vicon::steps

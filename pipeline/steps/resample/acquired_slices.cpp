#include "resample/acquired_slices.h"

#include <itkFlipImageFilter.h>
#include <itkPermuteAxesImageFilter.h>
#include <itkRegionOfInterestImageFilter.h>

namespace vicon::steps {
namespace {

ItkHu::Pointer permutedAndFlipped(const OrientedScan& scan, SliceRange range)
{
    using Permute = itk::PermuteAxesImageFilter<ItkHu>;
    auto permute = Permute::New();
    permute->SetNumberOfWorkUnits(1);
    permute->SetInput(itkView(scan.acquired.voxels.data(), scan.acquired.grid.size));
    Permute::PermuteOrderArrayType order;
    std::copy(scan.order.begin(), scan.order.end(), order.begin());
    permute->SetOrder(order);
    using Flip = itk::FlipImageFilter<ItkHu>;
    auto flip = Flip::New();
    flip->SetNumberOfWorkUnits(1);
    flip->SetInput(permute->GetOutput());
    Flip::FlipAxesArrayType flipped;
    std::copy(scan.flipped.begin(), scan.flipped.end(), flipped.begin());
    flip->SetFlipAxes(flipped);
    auto cut = itk::RegionOfInterestImageFilter<ItkHu, ItkHu>::New();
    cut->SetNumberOfWorkUnits(1);
    cut->SetInput(flip->GetOutput());
    ItkHu::RegionType region;
    region.SetIndex(2, range.begin);
    region.SetSize({itk::SizeValueType(scan.grid.size[0]), itk::SizeValueType(scan.grid.size[1]),
                    itk::SizeValueType(range.count())});
    cut->SetRegionOfInterest(region);
    cut->Update();
    ItkHu::Pointer slices = cut->GetOutput();
    slices->DisconnectPipeline();
    ItkHu::DirectionType straight;
    straight.SetIdentity();
    slices->SetDirection(straight);
    const std::array<double, 3> origin{}, spacing{1, 1, 1};
    slices->SetOrigin(origin.data());
    slices->SetSpacing(spacing.data());
    return slices;
}

}  // namespace

ItkHu::Pointer acquiredSlices(const OrientedScan& scan, SliceRange range)
{
    if (!scan.asStored())
        return permutedAndFlipped(scan, range);
    const auto& size = scan.grid.size;
    const std::size_t slice = std::size_t(size[0]) * std::size_t(size[1]);
    return itkView(scan.acquired.voxels.data() + slice * std::size_t(range.begin), {size[0], size[1], range.count()});
}

}  // namespace vicon::steps

#include <itkLinearInterpolateImageFunction.h>
#include <itkResampleImageFilter.h>
#include <itkVector.h>

#include "resample/interpolation.h"

namespace vicon::steps {
namespace {

// Neighbours of a row are interpolated together, as the components of one pixel: along the other axes all have the same
// weight, so what ITK works out for each pixel is worked out once for all of them. A scalar image takes five times as
// long.
constexpr int kTogether = 16;
using HuGroup = itk::Vector<std::int16_t, kTogether>;
using FloatGroup = itk::Vector<float, kTogether>;

template <class Value, class Group>
typename itk::Image<Group, 3>::Pointer grouped(itk::Image<Value, 3>& image)
{
    static_assert(sizeof(Group) == kTogether * sizeof(Value));
    const auto& size = image.GetLargestPossibleRegion().GetSize();
    return itkView(reinterpret_cast<Group*>(image.GetBufferPointer()),
                   {int(size[0]) / kTogether, int(size[1]), int(size[2])});
}

/// Along the rows, in rows that are filled up to whole groups.
ItkFloat::Pointer alongRows(ItkHu::Pointer slices, const Sampling& sampling)
{
    const auto& size = slices->GetLargestPossibleRegion().GetSize();
    const std::array<double, 3> spacing{sampling.acquired_in_new_voxels[0], 1, 1};
    slices->SetSpacing(spacing.data());
    const int row = (sampling.grid.size[0] + kTogether - 1) / kTogether * kTogether;
    auto filter = itk::ResampleImageFilter<ItkHu, ItkFloat>::New();
    filter->SetNumberOfWorkUnits(1);
    filter->SetInput(slices);
    filter->SetSize({itk::SizeValueType(row), size[1], size[2]});
    filter->Update();
    ItkFloat::Pointer rows = filter->GetOutput();
    rows->DisconnectPipeline();
    return rows;
}

/// Across rows and slices.
template <class Value, class Group>
ItkFloat::Pointer acrossRows(itk::Image<Value, 3>& from, int begin, const Sampling& sampling, SliceRange of_new)
{
    auto groups = grouped<Value, Group>(from);
    std::array<double, 3> spacing = sampling.acquired_in_new_voxels;
    spacing[0] = 1;
    const std::array<double, 3> origin{0, 0, begin * spacing[2]}, new_origin{0, 0, double(of_new.begin)};
    groups->SetSpacing(spacing.data());
    groups->SetOrigin(origin.data());
    const auto size = groups->GetLargestPossibleRegion().GetSize();
    const itk::Size<3> new_size{size[0], itk::SizeValueType(sampling.grid.size[1]), itk::SizeValueType(of_new.count())};
    auto out = ItkFloat::New();
    out->SetRegions(ItkFloat::SizeType{size[0] * kTogether, new_size[1], new_size[2]});
    out->Allocate();
    auto filter = itk::ResampleImageFilter<itk::Image<Group, 3>, itk::Image<FloatGroup, 3>>::New();
    filter->SetNumberOfWorkUnits(1);
    filter->SetInput(groups);
    filter->SetSize(new_size);
    filter->SetOutputOrigin(new_origin.data());
    filter->GraftOutput(grouped<float, FloatGroup>(*out));
    filter->Update();
    return out;
}

}  // namespace

ItkFloat::Pointer interpolateLinearly(const AcquiredSlab& acquired, const Sampling& sampling, SliceRange of_new)
{
    if (!sampling.moves(0) && sampling.acquired_size[0] % kTogether == 0)
        return acrossRows<std::int16_t, HuGroup>(*acquired.slices, acquired.range.begin, sampling, of_new);
    return acrossRows<float, FloatGroup>(*alongRows(acquired.slices, sampling), acquired.range.begin, sampling, of_new);
}

}  // namespace vicon::steps

#include "resample/slab.h"

#include <itkBinaryThresholdImageFilter.h>
#include <itkFlatStructuringElement.h>
#include <itkGrayscaleDilateImageFilter.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "resample/acquired_slices.h"
#include "resample/interpolation.h"
#include "resample/linear.h"
#include "resample/rounded.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

// What lies farther away changes a B-spline by less than a thousandth of an HU.
constexpr int kMargin_slices = 16;

/// Beside an edge smooth interpolation goes beyond the densities around it, but never to what stands for padding.
std::int16_t roundedOvershoot(float hu)
{
    const std::int16_t whole = rounded(std::clamp(hu, -32768.0F, 32767.0F));
    return whole == kPaddingHu ? std::int16_t(kPaddingHu + 1) : whole;
}

AcquiredSlab slabOf(const OrientedScan& scan, SliceRange range)
{
    return {acquiredSlices(scan, range), range};
}

/// The acquired voxels within `reach` of padding; null where there is no padding.
ItkMask::Pointer nearPadding(const AcquiredSlab& acquired, int reach)
{
    const std::int16_t* const begin = acquired.slices->GetBufferPointer();
    const std::int16_t* const end = begin + acquired.slices->GetLargestPossibleRegion().GetNumberOfPixels();
    if (std::find(begin, end, kPaddingHu) == end)
        return nullptr;
    auto padding = itk::BinaryThresholdImageFilter<ItkHu, ItkMask>::New();
    padding->SetInput(acquired.slices);
    padding->SetLowerThreshold(kPaddingHu);
    padding->SetUpperThreshold(kPaddingHu);
    padding->SetInsideValue(1);
    padding->SetOutsideValue(0);
    using Box = itk::FlatStructuringElement<3>;
    auto dilate = itk::GrayscaleDilateImageFilter<ItkMask, ItkMask, Box>::New();
    dilate->SetInput(padding->GetOutput());
    dilate->SetKernel(Box::Box(Box::SizeType::Filled(itk::SizeValueType(reach))));
    dilate->Update();
    ItkMask::Pointer mask = dilate->GetOutput();
    mask->DisconnectPipeline();
    return mask;
}

/// ITK's failures as the project's: there is nothing but memory that a resampling may lack.
void guarded(const std::function<void()>& work)
{
    try {
        work();
    } catch (const itk::ExceptionObject& failure) {
        throw Error(ErrorCode::no_memory, std::string("resampling failed: ") + failure.GetDescription(), {},
                    "use a machine with more memory, or set resample.spacing_mm to a larger spacing");
    }
}

}  // namespace

void resampleLinearly(const OrientedScan& scan, const Sampling& sampling, SliceRange of_new, std::int16_t* out)
{
    guarded([&] {
        const auto& size = sampling.grid.size;
        auto filter = LinearResampleFilter::New();
        filter->SetNumberOfWorkUnits(1);
        filter->setScan(scan, sampling);
        filter->GraftOutput(itkView(out, {size[0], size[1], of_new.count()}));
        ItkHu::RegionType slab({0, 0, of_new.begin}, {itk::SizeValueType(size[0]), itk::SizeValueType(size[1]),
                                                      itk::SizeValueType(of_new.count())});
        filter->GetOutput()->SetRequestedRegion(slab);
        filter->Update();
    });
}

void smoothOver(const OrientedScan& scan, const Sampling& sampling, SliceRange of_new, Interpolation interpolation,
                std::int16_t* out)
{
    guarded([&] {
        const AcquiredSlab acquired = slabOf(scan, sampling.acquiredAround(of_new, kMargin_slices));
        const ItkMask::Pointer near_padding = nearPadding(acquired, reachOf(interpolation));
        const ItkFloat::Pointer values = interpolateSmoothly(acquired, sampling, of_new, interpolation);
        const float* from = values->GetBufferPointer();
        for (int k = of_new.begin; k < of_new.end; ++k)
            for (const Tap& y : sampling.taps[1])
                for (const Tap& x : sampling.taps[0]) {
                    const int slice = sampling.taps[2][std::size_t(k)].nearest() - acquired.range.begin;
                    if (!near_padding || !near_padding->GetPixel({x.nearest(), y.nearest(), slice}))
                        *out = roundedOvershoot(*from);
                    ++from;
                    ++out;
                }
    });
}

}  // namespace vicon::steps

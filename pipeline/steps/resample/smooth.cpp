#include <itkBSplineInterpolateImageFunction.h>
#include <itkResampleImageFilter.h>
#include <itkWindowedSincInterpolateImageFunction.h>

#include <vector>

#include "resample/interpolation.h"

namespace vicon::steps {
namespace {

// Voxels on either side. No case recorded; reason: a definition, the three lobes of the usual Lanczos window.
constexpr unsigned kSincRadius = 3;
// A voxel's weight in the coefficients of the cubic B-spline falls by 2 - sqrt(3) a voxel: after eight, 0.03 HU are
// left of a thousand.
constexpr int kSplineReach = 8;

using Spline = itk::BSplineInterpolateImageFunction<ItkHu, double, float>;
using Sinc =
    itk::WindowedSincInterpolateImageFunction<ItkHu, kSincRadius, itk::Function::LanczosWindowFunction<kSincRadius>>;

template <class Interpolator>
ItkFloat::Pointer resampled(const AcquiredSlab& acquired, const Sampling& sampling, SliceRange of_new)
{
    const std::array<double, 3>& spacing = sampling.acquired_in_new_voxels;
    const std::array<double, 3> origin{0, 0, acquired.range.begin * spacing[2]}, new_origin{0, 0, double(of_new.begin)};
    acquired.slices->SetSpacing(spacing.data());
    acquired.slices->SetOrigin(origin.data());
    auto filter = itk::ResampleImageFilter<ItkHu, ItkFloat>::New();
    filter->SetInput(acquired.slices);
    filter->SetInterpolator(Interpolator::New());
    filter->SetSize({itk::SizeValueType(sampling.grid.size[0]), itk::SizeValueType(sampling.grid.size[1]),
                     itk::SizeValueType(of_new.count())});
    filter->SetOutputOrigin(new_origin.data());
    filter->Update();
    ItkFloat::Pointer image = filter->GetOutput();
    image->DisconnectPipeline();
    return image;
}

/// What the sinc makes of ones, at each new voxel along an axis.
std::vector<float> gainsAlong(const std::vector<Tap>& taps)
{
    constexpr int kSize = 2 * int(kSincRadius) + 2;  // voxels: the window around a place between two of them
    auto ones = ItkHu::New();
    ones->SetRegions(ItkHu::SizeType{kSize, kSize, kSize});
    ones->Allocate();
    ones->FillBuffer(1);
    auto sinc = Sinc::New();
    sinc->SetInputImage(ones);
    std::vector<float> gains;
    for (const Tap& tap : taps) {
        Sinc::ContinuousIndexType at;
        at.Fill(kSincRadius);
        at[0] += double(tap.weight);
        gains.push_back(float(sinc->EvaluateAtContinuousIndex(at)));
    }
    return gains;
}

/// The window's weights do not add up to one: without this, a constant density would ripple by one part in a hundred.
void divideByGains(ItkFloat& image, const Sampling& sampling, SliceRange of_new)
{
    const std::array gains{gainsAlong(sampling.taps[0]), gainsAlong(sampling.taps[1]), gainsAlong(sampling.taps[2])};
    float* value = image.GetBufferPointer();
    for (int k = of_new.begin; k < of_new.end; ++k)
        for (const float gain_y : gains[1]) {
            const float gain_yz = gain_y * gains[2][std::size_t(k)];
            for (const float gain_x : gains[0])
                *value++ /= gain_x * gain_yz;
        }
}

}  // namespace

int reachOf(Interpolation interpolation)
{
    return interpolation == Interpolation::windowed_sinc ? int(kSincRadius) : kSplineReach;
}

ItkFloat::Pointer interpolateSmoothly(const AcquiredSlab& acquired, const Sampling& sampling, SliceRange of_new,
                                      Interpolation interpolation)
{
    if (interpolation == Interpolation::bspline)
        return resampled<Spline>(acquired, sampling, of_new);
    ItkFloat::Pointer image = resampled<Sinc>(acquired, sampling, of_new);
    divideByGains(*image, sampling, of_new);
    return image;
}

}  // namespace vicon::steps

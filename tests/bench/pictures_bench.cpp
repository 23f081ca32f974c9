// A blurred volume and a slanting slice, as the phantom and the window make them, beside ITK's filters.
#include <itkDiscreteGaussianImageFilter.h>
#include <itkImage.h>
#include <itkLinearInterpolateImageFunction.h>
#include <itkResampleImageFilter.h>

#include <cmath>

#include "bench_support.h"
#include "imaging.h"
#include "vicon/viewer/model/slice_image.h"

namespace {

using namespace vicon;
using namespace vicon::bench;

using Hu = itk::Image<std::int16_t, 3>;

constexpr double kBlur_mm = 0.65;  // the phantom's usual point spread

void blurVicon(benchmark::State& state)
{
    repeat(state, [] { return phantom::imageScene(tube().hu, {.blur_mm = kBlur_mm, .noise_hu = 0}, quiet).voxels[0]; });
}

void blurItk(benchmark::State& state)
{
    const auto image = itkImage(tube().hu);
    repeat(state, [&] {
        auto filter = itk::DiscreteGaussianImageFilter<Hu, Hu>::New();
        filter->SetInput(image);
        filter->SetVariance(kBlur_mm * kBlur_mm);
        filter->Update();
        return filter->GetOutput()->GetBufferPointer()[0];
    });
}

/// A slice of a large picture that leans by 30 degrees about the left-right axis, through the middle of the scan.
viewer::PlaneView leaningSlice()
{
    constexpr int kSide = 1024;
    const Grid& grid = tube().hu.grid;
    const Point3 middle = grid.pointAt(Index3{grid.size[0] / 2, grid.size[1] / 2, grid.size[2] / 2});
    const double lean = viewer::radians(30);
    return viewer::sliceThrough(grid, viewer::SliceAxes{{1, 0, 0}, {0, std::sin(lean), -std::cos(lean)}}, middle, kSide,
                                kSide);
}

void sliceVicon(benchmark::State& state)
{
    const viewer::PlaneView view = leaningSlice();
    repeat(state, [&] { return viewer::sliceDensities(HuView(tube().hu), view)[0]; });
}

void sliceItk(benchmark::State& state)
{
    const auto image = itkImage(tube().hu);
    const viewer::PlaneView view = leaningSlice();
    const Point3 corner = view.pointAt({0.5, 0.5});
    const Vector3 forward = view.forward();
    Hu::DirectionType direction;
    for (unsigned d = 0; d < 3; ++d) {
        const auto of = [d](Vector3 v) { return d == 0 ? v.x : d == 1 ? v.y : v.z; };
        direction(d, 0) = of(view.right);
        direction(d, 1) = of(view.down);
        direction(d, 2) = of(forward);
    }
    const double origin_mm[3] = {corner.x, corner.y, corner.z};
    const double spacing_mm[3] = {view.mm_per_pixel, view.mm_per_pixel, 1};
    repeat(state, [&] {
        auto filter = itk::ResampleImageFilter<Hu, itk::Image<float, 3>>::New();
        filter->SetInput(image);
        filter->SetInterpolator(itk::LinearInterpolateImageFunction<Hu>::New());
        filter->SetSize({itk::SizeValueType(view.width), itk::SizeValueType(view.height), 1});
        filter->SetOutputOrigin(origin_mm);
        filter->SetOutputSpacing(spacing_mm);
        filter->SetOutputDirection(direction);
        filter->SetDefaultPixelValue(kPaddingHu);
        filter->Update();
        return filter->GetOutput()->GetBufferPointer()[0];
    });
}

const bool pictures_registered = [] {
    addBenchmark("blur/vicon", blurVicon);
    addBenchmark("blur/itk_DiscreteGaussian", blurItk);
    addBenchmark("slice/vicon", sliceVicon);
    addBenchmark("slice/itk_ResampleImageFilter", sliceItk);
    return true;
}();

}  // namespace

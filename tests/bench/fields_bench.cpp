// Resample, distances, subdivision and surface against the stock ITK and VTK filters that do the same, on 45 million
// voxels around 3 million inside voxels.
#include <benchmark/benchmark.h>
#include <itkBSplineInterpolateImageFunction.h>
#include <itkFastMarchingImageFilter.h>
#include <itkImage.h>
#include <itkLinearInterpolateImageFunction.h>
#include <itkResampleImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#include <itkWindowedSincInterpolateImageFunction.h>
#include <vtkImageData.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShortArray.h>

#include <algorithm>
#include <cmath>

#include "bench_support.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/exit_distance.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/wall_distance.h"

namespace {

using namespace vicon;
using namespace vicon::bench;

/// Noise without padding.
HuVolume slices(double slice_mm, int count)
{
    HuVolume volume(Grid{.size = {512, 512, count}, .spacing_mm = {0.7, 0.7, slice_mm}});
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(int((n * 2654435761U >> 20) % 1400) - 1000);
    return volume;
}

void resampleVicon(benchmark::State& state, steps::Interpolation interpolation, double slice_mm, int count = 200)
{
    const HuVolume acquired = slices(slice_mm, count);
    for ([[maybe_unused]] auto unused : state) {
        state.PauseTiming();
        HuVolume copy = acquired;
        state.ResumeTiming();
        benchmark::DoNotOptimize(steps::resample(std::move(copy), {.interpolation = interpolation}, quiet));
    }
}

template <class Interpolator>
void resampleItk(benchmark::State& state, double slice_mm, int count = 200)
{
    const HuVolume acquired = slices(slice_mm, count);
    const auto image = itkImage(acquired);
    using Image = itk::Image<std::int16_t, 3>;
    const double finest_mm = std::min(0.7, slice_mm);
    itk::Size<3> size;
    for (unsigned d = 0; d < 3; ++d) {
        const std::size_t a = d;
        size[d] = itk::SizeValueType((acquired.grid.size[a] - 1) * acquired.grid.spacing_mm[a] / finest_mm + 1e-6) + 1;
    }
    repeat(state, [&] {
        auto filter = itk::ResampleImageFilter<Image, Image>::New();
        filter->SetInput(image);
        filter->SetInterpolator(Interpolator::New());
        filter->SetSize(size);
        const double spacing_mm[3] = {finest_mm, finest_mm, finest_mm};
        filter->SetOutputSpacing(spacing_mm);
        filter->Update();
        return filter->GetOutput()->GetBufferPointer()[0];
    });
}

void thickVicon(benchmark::State& state)
{
    resampleVicon(state, steps::Interpolation::linear, 1);
}
void thickItk(benchmark::State& state)
{
    resampleItk<itk::LinearInterpolateImageFunction<itk::Image<std::int16_t, 3>>>(state, 1);
}
void thinVicon(benchmark::State& state)
{
    resampleVicon(state, steps::Interpolation::linear, 0.5);
}
void thinItk(benchmark::State& state)
{
    resampleItk<itk::LinearInterpolateImageFunction<itk::Image<std::int16_t, 3>>>(state, 0.5);
}
void bsplineVicon(benchmark::State& state)
{
    resampleVicon(state, steps::Interpolation::bspline, 1, 50);
}
void bsplineItk(benchmark::State& state)
{
    resampleItk<itk::BSplineInterpolateImageFunction<itk::Image<std::int16_t, 3>>>(state, 1, 50);
}
void sincVicon(benchmark::State& state)
{
    resampleVicon(state, steps::Interpolation::windowed_sinc, 1, 20);
}
void sincItk(benchmark::State& state)
{
    using Window = itk::Function::LanczosWindowFunction<3>;
    resampleItk<itk::WindowedSincInterpolateImageFunction<itk::Image<std::int16_t, 3>, 3, Window>>(state, 1, 20);
}

void wallVicon(benchmark::State& state)
{
    repeat(state, [] { return steps::wallDistance(tube().inside, quiet); });
}

void wallFineVicon(benchmark::State& state)
{
    repeat(state, [] { return steps::wallDistance(tube().inside, tube().hu, quiet); });
}

void wallItk(benchmark::State& state)
{
    const auto image = itkImage(tube().inside);
    repeat(state, [&] {
        auto filter = itk::SignedMaurerDistanceMapImageFilter<itk::Image<std::uint8_t, 3>, itk::Image<float, 3>>::New();
        filter->SetInput(image);
        filter->SquaredDistanceOff();
        filter->UseImageSpacingOn();
        filter->Update();
        return filter->GetOutput()->GetBufferPointer()[0];
    });
}

void exitVicon(benchmark::State& state)
{
    repeat(state, [] { return steps::exitDistance(tube().inside, tube().skeleton, quiet); });
}

void exitItk(benchmark::State& state)
{
    FieldVolume speed(tube().inside.grid);
    std::copy(tube().inside.voxels.begin(), tube().inside.voxels.end(), speed.voxels.begin());
    const auto image = itkImage(speed);
    using Image = itk::Image<float, 3>;
    using March = itk::FastMarchingImageFilter<Image, Image>;
    const Index3 start = speed.grid.indexAt(tube().skeleton.at(0).position_mm);
    repeat(state, [&] {
        auto march = March::New();
        auto seeds = March::NodeContainer::New();
        March::NodeType seed;
        seed.SetIndex({start.i, start.j, start.k});
        seed.SetValue(0);
        seeds->InsertElement(0, seed);
        march->SetInput(image);
        march->SetTrialPoints(seeds);
        march->Update();
        return march->GetOutput()->GetBufferPointer()[0];
    });
}

void subdivideVicon(benchmark::State& state)
{
    repeat(state, [] { return steps::subdivide(tube().inside, tube().skeleton, tube().path, {}, quiet); });
}

void cellsVicon(benchmark::State& state)
{
    SegmentVolume segments(tube().inside.grid);
    std::copy(tube().inside.voxels.begin(), tube().inside.voxels.end(), segments.voxels.begin());
    repeat(state, [&] { return steps::extractCells(tube().hu, tube().inside, segments, {}, quiet); });
}

void cellsVtk(benchmark::State& state)
{
    HuVolume copy = tube().hu;
    vtkNew<vtkShortArray> values;
    values->SetArray(copy.voxels.data(), vtkIdType(copy.voxels.size()), 1);
    vtkNew<vtkImageData> image;
    image->SetDimensions(copy.grid.size.data());
    image->SetSpacing(copy.grid.spacing_mm.data());
    image->GetPointData()->SetScalars(values);
    repeat(state, [&] {
        vtkNew<vtkMarchingCubes> cubes;
        cubes->SetInputData(image);
        cubes->SetValue(0, -480);
        cubes->ComputeNormalsOn();
        cubes->Update();
        return cubes->GetOutput()->GetNumberOfPolys();
    });
}

const bool fields_registered = [] {
    addBenchmark("resample/vicon", thickVicon);
    addBenchmark("resample/itk_ResampleImageFilter", thickItk);
    addBenchmark("resample_thin/vicon", thinVicon);
    addBenchmark("resample_thin/itk_ResampleImageFilter", thinItk);
    addBenchmark("resample_bspline/vicon", bsplineVicon);
    addBenchmark("resample_bspline/itk_ResampleImageFilter", bsplineItk);
    addBenchmark("resample_sinc/vicon", sincVicon);
    addBenchmark("resample_sinc/itk_ResampleImageFilter", sincItk);
    addBenchmark("wall_distance/vicon", wallVicon);
    addBenchmark("wall_distance/itk_SignedMaurer", wallItk);
    addBenchmark("wall_distance_fine/vicon", wallFineVicon);
    addBenchmark("exit_distance/vicon", exitVicon);
    addBenchmark("exit_distance/itk_FastMarching", exitItk);
    addBenchmark("subdivide/vicon", subdivideVicon);
    addBenchmark("cells/vicon", cellsVicon);
    addBenchmark("cells/vtkMarchingCubes", cellsVtk);
    return true;
}();

}  // namespace

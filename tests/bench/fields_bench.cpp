// Resample, distances, subdivision and surface against the stock ITK and VTK filters that do the same, on a tube as
// long and wide as a colon: 45 million voxels around 3 million inside voxels.
#include <benchmark/benchmark.h>
#include <itkFastMarchingImageFilter.h>
#include <itkImage.h>
#include <itkResampleImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#include <vtkImageData.h>
#include <vtkMarchingCubes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShortArray.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "vicon/steps/cells.h"
#include "vicon/steps/exit_distance.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/wall_distance.h"

namespace {

using namespace vicon;

NoProgress quiet;

constexpr int kWidth = 300, kDepth = 300, kHeight = 500;
constexpr double kVoxel_mm = 0.7, kRadius_mm = 16;

/// A folded tube in a box of 300 x 300 x 500 voxels: four limbs up and down, joined by bends.
struct Tube {
    InsideVolume inside{Grid{.size = {kWidth, kDepth, kHeight}, .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}}};
    HuVolume hu{inside.grid, 40};
    Skeleton skeleton;
    SkeletonVoxels path;

    Tube()
    {
        const std::vector<Point3> corners{{30, 40, 40},  {30, 40, 310},  {90, 160, 310},  {90, 160, 40},
                                          {150, 40, 40}, {150, 40, 310}, {180, 160, 310}, {180, 160, 40}};
        SkeletonPiece piece;
        double station = 0;
        for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
            const double length_mm = distance(corners[n], corners[n + 1]);
            for (double s = 0; s < length_mm; s += 1)
                piece.points.push_back(
                    {interpolate(corners[n], corners[n + 1], s / length_mm), station + s, kRadius_mm});
            station += length_mm;
        }
        skeleton.pieces.push_back(piece);
        std::vector<float> away2(inside.voxels.size(), std::numeric_limits<float>::max());
        for (const SkeletonPoint& p : piece.points)
            addBall(p, away2);
        for (std::size_t n = 0; n < away2.size(); ++n) {
            const double beyond = std::min(std::sqrt(double(away2[n])), 1e3) - kRadius_mm;
            hu.voxels[n] = std::int16_t(std::lround(-1000 + 1040 * std::clamp(0.5 + beyond / 2, 0.0, 1.0)));
            inside.voxels[n] = hu.voxels[n] < -480 ? kGas : kOutside;
        }
        path.emplace_back();
        for (double s = 0; s < station - 1; s += 0.3) {
            const Point3 p = inside.grid.pointAt(inside.grid.indexAt(skeleton.at(s).position_mm));
            if (path[0].empty() || path[0].back() != p)
                path[0].push_back(p);
        }
    }

    void addBall(const SkeletonPoint& p, std::vector<float>& away2) const
    {
        const Index3 c = inside.grid.indexAt(p.position_mm);
        const int reach = int((kRadius_mm + 2) / kVoxel_mm) + 1;
        for (int k = c.k - reach; k <= c.k + reach; ++k)
            for (int j = c.j - reach; j <= c.j + reach; ++j)
                for (int i = c.i - reach; i <= c.i + reach; ++i)
                    if (const Index3 v{i, j, k}; inside.grid.contains(v)) {
                        const Vector3 d = inside.grid.pointAt(v) - p.position_mm;
                        auto& least = away2[inside.grid.offset(v)];
                        least = std::min(least, float(dot(d, d)));
                    }
    }
};

const Tube& tube()
{
    static const Tube the_tube;
    return the_tube;
}

template <class T>
typename itk::Image<T, 3>::Pointer itkImage(const Volume<T>& volume)
{
    auto image = itk::Image<T, 3>::New();
    image->SetRegions(
        {std::size_t(volume.grid.size[0]), std::size_t(volume.grid.size[1]), std::size_t(volume.grid.size[2])});
    image->SetSpacing(volume.grid.spacing_mm.data());
    image->Allocate();
    std::copy(volume.voxels.begin(), volume.voxels.end(), image->GetBufferPointer());
    return image;
}

template <class Work>
void repeat(benchmark::State& state, Work work)
{
    tube();  // made outside the time measured
    for ([[maybe_unused]] auto unused : state)
        benchmark::DoNotOptimize(work());
}

HuVolume thickSlices()
{
    HuVolume volume(Grid{.size = {512, 512, 200}, .spacing_mm = {0.7, 0.7, 1}});
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(int(n * 2654435761U >> 20) % 1400 - 1000);
    return volume;
}

void resampleVicon(benchmark::State& state)
{
    const HuVolume acquired = thickSlices();
    for ([[maybe_unused]] auto unused : state) {
        state.PauseTiming();
        HuVolume copy = acquired;
        state.ResumeTiming();
        benchmark::DoNotOptimize(steps::resample(std::move(copy), {}, quiet));
    }
}

void resampleItk(benchmark::State& state)
{
    const auto image = itkImage(thickSlices());
    using Image = itk::Image<std::int16_t, 3>;
    repeat(state, [&] {
        auto filter = itk::ResampleImageFilter<Image, Image>::New();
        filter->SetInput(image);
        filter->SetSize({512, 512, 285});
        const double spacing_mm[3] = {0.7, 0.7, 0.7};
        filter->SetOutputSpacing(spacing_mm);
        filter->Update();
        return filter->GetOutput()->GetBufferPointer()[0];
    });
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

void addBenchmark(const char* name, void (*work)(benchmark::State&))
{
    benchmark::RegisterBenchmark(name, work)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime()
        ->MinTime(0.5);
}

const bool registered = [] {
    addBenchmark("resample/vicon", resampleVicon);
    addBenchmark("resample/itk_ResampleImageFilter", resampleItk);
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

// The general image operations that the steps do themselves, each beside ITK's filter for the same thing.
#include <itkBinShrinkImageFilter.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkFastMarchingExtensionImageFilter.h>
#include <itkFastMarchingImageFilter.h>
#include <itkFlatStructuringElement.h>
#include <itkGrayscaleDilateImageFilter.h>
#include <itkGrayscaleErodeImageFilter.h>

#include "bench_support.h"
#include "grid/blocks.h"
#include "grid/components.h"
#include "grid/lumen_graph.h"
#include "segment/body.h"
#include "segment/lumen.h"
#include "segment/region_grower.h"
#include "tissue/near_mask.h"
#include "tissue/smooth_along_wall.h"
#include "vicon/steps/subdivide.h"
#include "vicon/steps/wall_distance.h"

namespace {

using namespace vicon;
using namespace vicon::bench;

using Mask = itk::Image<std::uint8_t, 3>;
using Hu = itk::Image<std::int16_t, 3>;
using Field = itk::Image<float, 3>;

void labelFaces(benchmark::State& state)
{
    repeat(state, [] { return steps::labelLumen(tube().inside, steps::Neighbours::faces); });
}

void labelCorners(benchmark::State& state)
{
    repeat(state, [] { return steps::Components(tube().inside, kGas).count(); });
}

template <bool kCorners>
void labelItk(benchmark::State& state)
{
    const auto image = itkImage(tube().inside);
    repeat(state, [&] {
        auto filter = itk::ConnectedComponentImageFilter<Mask, itk::Image<std::uint32_t, 3>>::New();
        filter->SetInput(image);
        filter->SetFullyConnected(kCorners);
        filter->Update();
        return filter->GetObjectCount();
    });
}

/// What the body's search does on its grid of blocks.
Volume<std::uint8_t> coarseMask()
{
    Volume<std::uint8_t> mask(Grid{.size = {128, 128, 145}});
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        mask.voxels[n] = std::uint8_t(n * 2654435761U >> 28 & 7U) != 0;
    return mask;
}

void openingVicon(benchmark::State& state)
{
    const auto mask = coarseMask();
    repeat(state, [&] { return steps::dilatedByBox(steps::erodedByBox(mask)); });
}

void openingItk(benchmark::State& state)
{
    const auto image = itkImage(coarseMask());
    using Box = itk::FlatStructuringElement<3>;
    const Box box = Box::Box(Box::SizeType::Filled(1));
    repeat(state, [&] {
        auto erode = itk::GrayscaleErodeImageFilter<Mask, Mask, Box>::New();
        erode->SetInput(image);
        erode->SetKernel(box);
        auto dilate = itk::GrayscaleDilateImageFilter<Mask, Mask, Box>::New();
        dilate->SetInput(erode->GetOutput());
        dilate->SetKernel(box);
        dilate->Update();
        return dilate->GetOutput()->GetBufferPointer()[0];
    });
}

constexpr int kReach_voxels = 8;

void nearVicon(benchmark::State& state)
{
    repeat(state, [] { return steps::nearMask(tube().inside, kGas, kReach_voxels); });
}

void nearItk(benchmark::State& state)
{
    const auto image = itkImage(tube().inside);
    using Box = itk::FlatStructuringElement<3>;
    const Box box = Box::Box(Box::SizeType::Filled(kReach_voxels));
    repeat(state, [&] {
        auto dilate = itk::GrayscaleDilateImageFilter<Mask, Mask, Box>::New();
        dilate->SetInput(image);
        dilate->SetKernel(box);
        dilate->Update();
        return dilate->GetOutput()->GetBufferPointer()[0];
    });
}

/// The tube's wall as a fraction of tissue.
steps::TissueVolume fractionOfTissue()
{
    steps::TissueVolume tissue(tube().hu.grid);
    std::transform(tube().hu.voxels.begin(), tube().hu.voxels.end(), tissue.voxels.begin(),
                   [](std::int16_t hu) { return std::uint8_t((hu + 1000) * 255 / 1040); });
    return tissue;
}

void smoothVicon(benchmark::State& state)
{
    const steps::TissueVolume tissue = fractionOfTissue();
    repeat(state, [&] {
        steps::TissueVolume smoothed = tissue;
        steps::smoothAlongWall({}, smoothed);
        return smoothed.voxels[0];
    });
}

/// What comes closest: it, too, keeps edges and evens out what runs along them, in as many passes.
void smoothItk(benchmark::State& state)
{
    FieldVolume fraction(tube().hu.grid);
    const steps::TissueVolume tissue = fractionOfTissue();
    std::copy(tissue.voxels.begin(), tissue.voxels.end(), fraction.voxels.begin());
    const auto image = itkImage(fraction);
    repeat(state, [&] {
        auto diffusion = itk::CurvatureAnisotropicDiffusionImageFilter<Field, Field>::New();
        diffusion->SetInput(image);
        diffusion->SetNumberOfIterations(3);
        diffusion->SetTimeStep(0.04);  // below its limit of spacing / 2^4
        diffusion->SetConductanceParameter(3);
        diffusion->Update();
        return diffusion->GetOutput()->GetBufferPointer()[0];
    });
}

void blocksVicon(benchmark::State& state)
{
    repeat(state, [] { return steps::meanOfBlocks(tube().hu, 4); });
}

void blocksItk(benchmark::State& state)
{
    const auto image = itkImage(tube().hu);
    repeat(state, [&] {
        auto filter = itk::BinShrinkImageFilter<Hu, Hu>::New();
        filter->SetInput(image);
        filter->SetShrinkFactors(4);
        filter->Update();
        return filter->GetOutput()->GetBufferPointer()[0];
    });
}

steps::Body wholeBody()
{
    steps::Body body;
    body.factor = 4;
    body.mean_hu = steps::meanOfBlocks(tube().hu, 4);
    body.inside = Volume<std::uint8_t>(body.mean_hu.grid, 1);
    return body;
}

void regionVicon(benchmark::State& state)
{
    const steps::Body body = wholeBody();
    steps::RegionGrower grower(tube().hu, body, steps::RegionGrower::Padding::stops);
    const Index3 seed = tube().inside.grid.indexAt(tube().skeleton.at(0).position_mm);
    repeat(state, [&] { return grower.grow(seed, -1024, -800, 3).voxels; });
}

/// What the growing did before it was ITK's: all components, and the one at the seed.
void regionByLabels(benchmark::State& state)
{
    const steps::Body body = wholeBody();
    const Index3 seed = tube().inside.grid.indexAt(tube().skeleton.at(0).position_mm);
    repeat(state, [&] { return steps::findGas(tube().hu, body, -799).labelAt(seed); });
}

/// Speed 1 inside, 0 outside.
Field::Pointer speedImage()
{
    FieldVolume speed(tube().inside.grid);
    std::copy(tube().inside.voxels.begin(), tube().inside.voxels.end(), speed.voxels.begin());
    return itkImage(speed);
}

std::vector<std::vector<Index3>> pathVoxels()
{
    std::vector<Index3> path;
    for (const Point3 p : tube().path[0])
        path.push_back(tube().inside.grid.indexAt(p));
    return {path};
}

void floodVicon(benchmark::State& state)
{
    const auto paths = pathVoxels();
    repeat(state, [&] { return steps::floodFromPaths(tube().inside, paths); });
}

void floodItk(benchmark::State& state)
{
    const auto speed = speedImage();
    const auto paths = pathVoxels();
    using March = itk::FastMarchingExtensionImageFilter<Field, std::uint16_t, 1, Field>;
    repeat(state, [&] {
        auto march = March::New();
        auto seeds = March::NodeContainer::New();
        auto labels = March::AuxValueContainer::New();
        for (unsigned n = 0; n < paths[0].size(); ++n) {
            March::NodeType seed;
            seed.SetIndex({paths[0][n].i, paths[0][n].j, paths[0][n].k});
            seed.SetValue(0);
            seeds->InsertElement(n, seed);
            March::AuxValueVectorType label;
            label[0] = std::uint16_t(n + 1);
            labels->InsertElement(n, label);
        }
        march->SetInput(speed);
        march->SetTrialPoints(seeds);
        march->SetAuxiliaryTrialValues(labels);
        march->Update();
        return march->GetAuxiliaryImage(0)->GetBufferPointer()[0];
    });
}

/// Distances inside the lumen on its thinned graph, as the skeleton takes them.
void geodesicVicon(benchmark::State& state)
{
    const FieldVolume wall_mm = steps::wallDistance(tube().inside, quiet);
    repeat(state, [&] {
        const steps::LumenGraph graph = steps::makeWholeGraph(wall_mm, 2, quiet);
        return steps::centralTree(graph, graph.nearest(tube().skeleton.at(0).position_mm), {}, quiet).cost.back();
    });
}

void geodesicItk(benchmark::State& state)
{
    const auto speed = speedImage();
    const Index3 start = tube().inside.grid.indexAt(tube().skeleton.at(0).position_mm);
    using March = itk::FastMarchingImageFilter<Field, Field>;
    repeat(state, [&] {
        auto march = March::New();
        auto seeds = March::NodeContainer::New();
        March::NodeType seed;
        seed.SetIndex({start.i, start.j, start.k});
        seed.SetValue(0);
        seeds->InsertElement(0, seed);
        march->SetInput(speed);
        march->SetTrialPoints(seeds);
        march->Update();
        return march->GetOutput()->GetBufferPointer()[0];
    });
}

const bool operations_registered = [] {
    addBenchmark("label_faces/vicon", labelFaces);
    addBenchmark("label_faces/itk_ConnectedComponent", labelItk<false>);
    addBenchmark("label_corners/vicon", labelCorners);
    addBenchmark("label_corners/itk_ConnectedComponent", labelItk<true>);
    addBenchmark("opening/vicon", openingVicon);
    addBenchmark("opening/itk_GrayscaleErodeDilate", openingItk);
    addBenchmark("near_mask/vicon", nearVicon);
    addBenchmark("near_mask/itk_GrayscaleDilate", nearItk);
    addBenchmark("smooth_along_wall/vicon", smoothVicon);
    addBenchmark("smooth_along_wall/itk_CurvatureAnisotropicDiffusion", smoothItk);
    addBenchmark("block_means/vicon", blocksVicon);
    addBenchmark("block_means/itk_BinShrink", blocksItk);
    addBenchmark("region/vicon", regionVicon);
    addBenchmark("region/all_components", regionByLabels);
    addBenchmark("flood/vicon", floodVicon);
    addBenchmark("flood/itk_FastMarchingExtension", floodItk);
    addBenchmark("geodesic/vicon", geodesicVicon);
    addBenchmark("geodesic/itk_FastMarching", geodesicItk);
    return true;
}();

}  // namespace

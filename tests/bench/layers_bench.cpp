// Layers of voxels put on and taken off, and holes filled: each beside ITK's filters for the same thing.
#include <itkFlatStructuringElement.h>
#include <itkGrayscaleErodeImageFilter.h>
#include <itkGrayscaleFillholeImageFilter.h>
#include <itkGrayscaleGeodesicDilateImageFilter.h>
#include <itkImportImageFilter.h>

#include "bench_support.h"
#include "grid/slice_holes.h"
#include "segment/fluid/rim.h"
#include "segment/lumen.h"

namespace {

using namespace vicon;
using namespace vicon::bench;

using Mask = itk::Image<std::uint8_t, 3>;
using Slice = itk::Image<std::uint8_t, 2>;

constexpr double kGas_hu = -800, kWall_hu = -480;
constexpr int kLayers = 3;  // a blurred edge of 2.1 mm; a leak's width

InsideVolume below(double hu)
{
    InsideVolume mask(tube().inside.grid);
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        mask.voxels[n] = tube().hu.voxels[n] < hu ? kGas : kOutside;
    return mask;
}

void growVicon(benchmark::State& state)
{
    const InsideVolume gas = below(kGas_hu);
    repeat(state, [&] {
        InsideVolume labels = gas;
        steps::growToWall(tube().hu, kWall_hu, labels);
        return labels.voxels.back();
    });
}

void growItk(benchmark::State& state)
{
    const auto gas = itkImage(below(kGas_hu)), may = itkImage(below(kWall_hu));
    repeat(state, [&] {
        Mask::Pointer grown = gas;
        for (int layer = 0; layer < kLayers; ++layer) {
            auto dilate = itk::GrayscaleGeodesicDilateImageFilter<Mask, Mask>::New();
            dilate->SetMarkerImage(grown);
            dilate->SetMaskImage(may);
            dilate->SetRunOneIteration(true);
            dilate->Update();
            grown = dilate->GetOutput();
        }
        return grown->GetBufferPointer()[0];
    });
}

/// The tube, full.
InsideVolume pool()
{
    InsideVolume fluid = tube().inside;
    for (std::uint8_t& label : fluid.voxels)
        label = label == kOutside ? kOutside : kFluid;
    return fluid;
}

void rimVicon(benchmark::State& state)
{
    const InsideVolume fluid = pool();
    repeat(state, [&] {
        InsideVolume labels = fluid;
        steps::markFluidRim(labels, kLayers);
        return labels.voxels.back();
    });
}

void rimItk(benchmark::State& state)
{
    const auto fluid = itkImage(pool());
    using Element = itk::FlatStructuringElement<3>;
    repeat(state, [&] {
        Mask::Pointer left = fluid;
        for (int layer = 0; layer < kLayers; ++layer) {
            auto erode = itk::GrayscaleErodeImageFilter<Mask, Mask, Element>::New();
            erode->SetInput(left);
            const auto one = Element::RadiusType::Filled(1);
            erode->SetKernel(layer % 2 == 1 ? Element::Box(one) : Element::Cross(one));
            erode->Update();
            left = erode->GetOutput();
        }
        return left->GetBufferPointer()[0];
    });
}

/// The body's ring in each slice, on the grid of blocks: holes, and an outside to tell them from.
Volume<std::uint8_t> rings()
{
    Volume<std::uint8_t> mask(Grid{.size = {128, 128, 145}});
    for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
        const Index3 v = mask.grid.indexOf(n);
        const int away2 = (v.i - 64) * (v.i - 64) + (v.j - 64) * (v.j - 64);
        mask.voxels[n] = away2 > 40 * 40 && away2 < 50 * 50;
    }
    return mask;
}

void fillVicon(benchmark::State& state)
{
    const auto mask = rings();
    repeat(state, [&] {
        auto filled = mask;
        steps::fillSlices(filled);
        return filled.voxels.back();
    });
}

void fillItk(benchmark::State& state)
{
    auto mask = rings();
    const auto columns = itk::SizeValueType(mask.grid.size[0]), rows = itk::SizeValueType(mask.grid.size[1]);
    repeat(state, [&] {
        int sum = 0;
        for (int k = 0; k < mask.grid.size[2]; ++k) {
            auto slice = itk::ImportImageFilter<std::uint8_t, 2>::New();
            slice->SetRegion(Slice::RegionType({columns, rows}));
            slice->SetImportPointer(&mask.at({0, 0, k}), columns * rows, false);
            auto fill = itk::GrayscaleFillholeImageFilter<Slice, Slice>::New();
            fill->SetInput(slice->GetOutput());
            fill->Update();
            sum += fill->GetOutput()->GetBufferPointer()[0];
        }
        return sum;
    });
}

const bool layers_registered = [] {
    addBenchmark("grow_to_wall/vicon", growVicon);
    addBenchmark("grow_to_wall/itk_GeodesicDilate", growItk);
    addBenchmark("fluid_rim/vicon", rimVicon);
    addBenchmark("fluid_rim/itk_GrayscaleErode", rimItk);
    addBenchmark("fill_slices/vicon", fillVicon);
    addBenchmark("fill_slices/itk_GrayscaleFillhole", fillItk);
    return true;
}();

}  // namespace

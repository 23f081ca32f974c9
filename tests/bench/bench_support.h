#pragma once

#include <benchmark/benchmark.h>
#include <itkImage.h>

#include <algorithm>

#include "vicon/core/progress.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"
#include "vicon/steps/skeleton.h"

namespace vicon::bench {

inline NoProgress quiet;

/// A folded tube in a box of 300 x 300 x 500 voxels of 0.7 mm, as long and wide as a colon: four limbs up and down,
/// joined by bends.
struct Tube {
    Tube();
    InsideVolume inside;
    HuVolume hu;
    Skeleton skeleton;
    SkeletonVoxels path;
};

/// The tube, made once.
const Tube& tube();

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

inline void addBenchmark(const char* name, void (*work)(benchmark::State&))
{
    benchmark::RegisterBenchmark(name, work)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->UseRealTime()
        ->MinTime(0.5);
}

}  // namespace vicon::bench

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "grid/blocks.h"
#include "grid/slice_holes.h"
#include "segment/given/on_grid.h"
#include "segment/signal/classes.h"
#include "vicon/steps/lumen_contrast.h"

namespace vicon::steps {
namespace {

/// Steps of a voxel within or around a given lumen where its edge no longer shows.
constexpr int kWellWithin_voxels = 2, kAround_voxels = 4;

/// No signal, the fainter and the brighter of fat and muscle, and a bright lumen.
unsigned classesOf(LumenContrast contrast)
{
    return contrast == LumenContrast::dark ? 3 : 4;
}

/// The median of what lies above one value and not above another.
double medianBetween(const HuVolume& signal, double above, double most)
{
    std::vector<std::int16_t> values;
    for (const std::int16_t v : signal.voxels)
        if (v != kPaddingHu && v > above && v <= most)
            values.push_back(v);
    return middleOf(values);
}

/// The median of what gives no signal within the body, of means over blocks: less noise, which no magnitude is free of.
double medianOfHoles(const HuVolume& signal, double below)
{
    constexpr double kBlock_mm = 4;  // no case recorded; reason: air in the body is wider
    const HuVolume blocks = meanOfBlocks(signal, std::max(1, int(std::lround(kBlock_mm / signal.grid.spacing_mm[0]))));
    InsideVolume body(blocks.grid);
    for (std::size_t n = 0; n < blocks.voxels.size(); ++n)
        body.voxels[n] = blocks.voxels[n] > below ? 1 : 0;
    fillSlices(body);
    body = erodedByBox(erodedByBox(body));
    std::vector<std::int16_t> holes;
    for (std::size_t n = 0; n < blocks.voxels.size(); ++n)
        if (body.voxels[n] && blocks.voxels[n] < below)
            holes.push_back(blocks.voxels[n]);
    return middleOf(holes);
}

void takeOptions(const SignalOptions& options, SignalLevels& levels)
{
    if (options.lumen_signal > 0)
        levels.lumen = options.lumen_signal;
    if (options.tissue_signal > 0)
        levels.tissue = options.tissue_signal;
}

/// Voxels of a mask by their distance from its rim along the axes: the least over the six directions.
bool isSurroundedBy(const InsideVolume& mask, Index3 v, int steps, bool inside)
{
    const std::array<Index3, 6> ends{Index3{v.i - steps, v.j, v.k}, {v.i + steps, v.j, v.k}, {v.i, v.j - steps, v.k},
                                     {v.i, v.j + steps, v.k},       {v.i, v.j, v.k - steps}, {v.i, v.j, v.k + steps}};
    return std::all_of(ends.begin(), ends.end(),
                       [&](Index3 end) { return (mask.valueOr(end, kOutside) != kOutside) == inside; });
}

bool touches(const InsideVolume& mask, Index3 v, int steps)
{
    return !isSurroundedBy(mask, v, steps, false);
}

}  // namespace

SignalLevels levelsOf(const HuVolume& signal, LumenContrast contrast, const SignalOptions& options)
{
    constexpr double kHighest = 32767;  // of 16 bits
    SignalLevels levels{.contrast = contrast};
    const std::vector<double> limits = classLimits(signal, classesOf(contrast) - 1);
    levels.air_below = limits[0];
    if (contrast == LumenContrast::dark) {  // told from what is nearest to it
        levels.lumen = medianOfHoles(signal, limits[0]);
        levels.tissue = medianBetween(signal, limits[0], limits[1]);
    } else {
        levels.tissue = medianBetween(signal, limits[1], limits[2]);
        levels.lumen = medianBetween(signal, limits[2], kHighest);
    }
    takeOptions(options, levels);
    return levels;
}

SignalLevels levelsWithin(const HuVolume& signal, const InsideVolume& lumen, const SignalOptions& options)
{
    const InsideVolume mask = onGrid(lumen, signal.grid);
    const Index3 low = signal.grid.indexAt(mask.grid.origin_mm);
    std::vector<std::int16_t> within, around;
    for (int k = 0; k < signal.grid.size[2]; ++k)
        for (int j = 0; j < signal.grid.size[1]; ++j)
            for (int i = 0; i < signal.grid.size[0]; ++i) {
                const Index3 v{i - low.i, j - low.j, k - low.k};
                const bool in = mask.valueOr(v, kOutside) != kOutside;
                if (in && isSurroundedBy(mask, v, kWellWithin_voxels, true))
                    within.push_back(signal.at({i, j, k}));
                else if (!in && touches(mask, v, kAround_voxels) && !touches(mask, v, kWellWithin_voxels))
                    around.push_back(signal.at({i, j, k}));
            }
    SignalLevels levels{.lumen = middleOf(within), .tissue = middleOf(around)};
    takeOptions(options, levels);
    levels.contrast = levels.lumen < levels.tissue ? LumenContrast::dark : LumenContrast::bright;
    levels.air_below = classLimits(signal, classesOf(levels.contrast) - 1).front();
    return levels;
}

}  // namespace vicon::steps

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/allocate.h"
#include "grid/run_labels.h"
#include "segment/constants.h"
#include "vicon/steps/lumen_contrast.h"

namespace vicon::steps {
namespace {

constexpr double kLowest_hu = -1600;  // noise below the lumen: cut off nearer, its mean would rise
/// What is brighter than tissue, or darker where the lumen is bright: below tagged fluid, above the noise of tissue.
constexpr double kAnythingElse_hu = 110;

/// Never the value that stands for padding.
std::int16_t measured(double value)
{
    const auto rounded = std::int16_t(std::lround(value));
    return rounded == kPaddingHu ? std::int16_t(kPaddingHu + 1) : rounded;
}

/// Runs of what lies below a limit.
RunLabels componentsBelow(const HuVolume& volume, double limit)
{
    const auto scan = [&](int j, int k, std::vector<VoxelRun>& runs) {
        const std::int16_t* row = &volume.voxels[volume.grid.offset({0, j, k})];
        const std::size_t first = runs.size();
        for (int i = 0; i < volume.grid.size[0]; ++i) {
            if (row[i] > limit)
                continue;
            if (runs.size() == first || runs.back().end != i)
                runs.push_back({i, i, 0, 0});
            ++runs.back().end;
        }
    };
    return labelRuns(volume.grid.size, scan, Neighbours::faces);
}

/// Lungs give no signal either, and leave the scan through its upper end. Bowel does not, in a scan of a colon.
void fillLungs(HuVolume& scaled)
{
    // No case recorded; reason: air alone is as dark, lungs reach the uppermost slices and are never as small.
    constexpr double kCore_hu = -800, kTop_mm = 8, kLungSize_ml = 10;
    const RunLabels dark = componentsBelow(scaled, kCore_hu);
    const Grid& grid = scaled.grid;
    dark.forEachRun([&](const VoxelRun& run, int j, int k) {
        const RunComponent& c = dark.components[run.label];
        const double below_top_mm = (grid.size[2] - 1 - c.upper.k) * grid.spacing_mm[2];
        const bool around =
            c.lower.i == 0 || c.lower.j == 0 || c.upper.i == grid.size[0] - 1 || c.upper.j == grid.size[1] - 1;
        if (!around && below_top_mm<kTop_mm&& double(c.voxels) * grid.voxelVolume_mm3() / 1000> kLungSize_ml)
            std::fill_n(&scaled.at({run.begin, j, k}), run.end - run.begin, std::int16_t(kAnythingElse_hu));
    });
}

/// Around the body: what gives no signal and reaches a side of the scan.
void clearAirAround(const HuVolume& signal, double air_below, HuVolume& scaled)
{
    const RunLabels air = componentsBelow(signal, air_below);
    air.forEachRun([&](const VoxelRun& run, int j, int k) {
        const RunComponent& c = air.components[run.label];
        if (c.lower.i == 0 || c.lower.j == 0 || c.upper.i == signal.grid.size[0] - 1 ||
            c.upper.j == signal.grid.size[1] - 1)
            std::fill_n(&scaled.at({run.begin, j, k}), run.end - run.begin, std::int16_t(kAir_hu));
    });
}

}  // namespace

HuVolume onLumenScale(const HuVolume& signal, const SignalLevels& levels)
{
    const double slope = (kUsualTissue_hu - kAir_hu) / (levels.tissue - levels.lumen);
    auto scaled = makeVolume<std::int16_t>(signal.grid);
    tbb::parallel_for(0, signal.grid.size[2], [&](int k) {
        const std::size_t begin = signal.grid.offset({0, 0, k}), end = signal.grid.offset({0, 0, k + 1});
        for (std::size_t n = begin; n < end; ++n)
            scaled.voxels[n] = signal.voxels[n] == kPaddingHu
                                   ? kPaddingHu
                                   : measured(std::clamp(kAir_hu + slope * (signal.voxels[n] - levels.lumen),
                                                         kLowest_hu, kAnythingElse_hu));
    });
    if (levels.contrast == LumenContrast::bright)
        clearAirAround(signal, levels.air_below, scaled);
    else
        fillLungs(scaled);
    return scaled;
}

}  // namespace vicon::steps

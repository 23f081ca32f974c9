#include "tissue/stool_in_fluid.h"

#include <algorithm>
#include <cstdint>

#include "grid/byte_rows.h"
#include "grid/neighbours.h"
#include "tissue/direct_step.h"
#include "tissue/stool.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 3 and 301 with --stool. Held by Stool.
constexpr double kMostUpwards = 0.6;  // of a lump's ways to gas; of a puddle's .9 and more

/// Takes all fluid that hangs together with a voxel, over faces.
std::vector<std::size_t> take(const InsideVolume& inside, std::size_t first, std::vector<std::uint8_t>& taken)
{
    std::vector<std::size_t> fluid{first};
    taken[first] = 1;
    floodOverFaces(inside.grid, {first}, [&](std::size_t n) {
        if (inside.voxels[n] != kFluid || taken[n])
            return false;
        taken[n] = 1;
        fluid.push_back(n);
        return true;
    });
    return fluid;
}

/// Whether a voxel of fluid meets gas in a direction, no wall between them.
bool meetsGas(const InsideVolume& inside, const DirectStep& step, Index3 fluid, Index3 direction)
{
    for (int n = 1; n <= DirectStep::kFarthest_voxels; ++n) {
        const Index3 v = along(fluid, direction, n);
        if (const std::uint8_t label = inside.valueOr(v, kFluid); label != kOutside)
            return label == kGas && step.isDirect(v, {-direction.i, -direction.j, -direction.k}, n);
    }
    return false;
}

/// The share of ways from fluid to gas that lead upwards.
double upwardsShare(const InsideVolume& inside, const DirectStep& step, const DownAxis& down,
                    const std::vector<std::size_t>& fluid)
{
    std::size_t up = 0, all = 0;
    for (const std::size_t n : fluid)
        for (const Index3 face : kFaces)
            if (meetsGas(inside, step, inside.grid.indexOf(n), face)) {
                ++all;
                up += down.along(face) * down.sign < 0 ? 1 : 0;
            }
    return all ? double(up) / double(all) : 1;
}

}  // namespace

std::vector<std::size_t> stoolInFluid(const Mixture& mixture, const DownAxis& down, double blur_mm)
{
    const InsideVolume& inside = mixture.inside;
    const DirectStep step(mixture, blur_mm);
    const auto largest = std::size_t(kLargestStool_mm3 / inside.grid.voxelVolume_mm3());
    std::vector<std::uint8_t> taken(inside.voxels.size(), 0);
    std::vector<std::size_t> stool;
    const std::uint8_t* labels = inside.voxels.data();
    const std::size_t end = inside.voxels.size();
    for (std::size_t n = firstOther(labels, std::size_t(0), end, kOutside); n < end;
         n = firstOther(labels, n + 1, end, kOutside)) {
        if (labels[n] != kFluid || taken[n])
            continue;
        const std::vector<std::size_t> fluid = take(inside, n, taken);
        if (fluid.size() <= largest && upwardsShare(inside, step, down, fluid) < kMostUpwards)
            stool.insert(stool.end(), fluid.begin(), fluid.end());
    }
    std::sort(stool.begin(), stool.end());
    return stool;
}

}  // namespace vicon::steps

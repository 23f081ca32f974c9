#include "tissue/direct_step.h"

#include <algorithm>
#include <array>

#include "grid/neighbours.h"

namespace vicon::steps {
namespace {

/// The layer in which the densities pass through those of tissue is at most this thick, in sigma of the blur: half-way
/// to half-way of a blurred step from gas to 200 HU it is 1.7, aslant 2. A wall between them makes it thicker: one
/// of 1.5 mm as thick as it is. Held by Stool.
constexpr double kThickestStep = 2.15;
constexpr int kBehind_voxels = 2;  // tagging is brightest behind its blurred edge

}  // namespace

DirectStep::DirectStep(const Mixture& mixture, double blur_mm)
    : mixture_(mixture), thickest_mm_(kThickestStep * blur_mm)
{
}

bool DirectStep::isDirect(Index3 gas, Index3 direction, int steps) const
{
    std::array<double, kFarthest_voxels + kBehind_voxels + 1> hu{};
    const int count = std::min(steps, kFarthest_voxels) + kBehind_voxels;
    double brightest_hu = 0;
    for (int n = 0; n <= count; ++n) {
        hu[std::size_t(n)] = mixture_.hu(along(gas, direction, n));
        brightest_hu = std::max(brightest_hu, hu[std::size_t(n)]);
    }
    const double wall_hu = (mixture_.gas_hu + mixture_.tissue_hu) / 2,
                 half_hu = (mixture_.tissue_hu + brightest_hu) / 2;
    const double step_mm = stepLength_mm(mixture_.inside.grid, direction);
    double leaves_gas = 0;
    for (int n = 1; n <= count; ++n) {
        const double a = hu[std::size_t(n - 1)], b = hu[std::size_t(n)];
        if (a <= wall_hu && b > wall_hu)
            leaves_gas = n - 1 + (wall_hu - a) / (b - a);
        if (b >= half_hu) {
            const double enters = b > a && a < half_hu ? n - 1 + (half_hu - a) / (b - a) : n;
            return (enters - leaves_gas) * step_mm <= thickest_mm_;
        }
    }
    return false;
}

}  // namespace vicon::steps

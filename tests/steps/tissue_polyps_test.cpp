#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tissue_scene.h"

namespace vicon::steps {
namespace {

/// How far from a place along a direction the fraction falls to one half, mm.
double toWall_mm(const TissueVolume& tissue, Point3 from, Vector3 direction)
{
    constexpr double kStep_mm = 0.05;
    const auto at = [&](double off_mm) {
        const ContinuousIndex3 p = tissue.grid.continuousIndexAt(from + direction * off_mm);
        double sum = 0;
        for (int n = 0; n < 8; ++n) {
            const Index3 v{int(std::floor(p.i)) + (n & 1), int(std::floor(p.j)) + (n >> 1 & 1),
                           int(std::floor(p.k)) + (n >> 2)};
            sum += (1 - std::abs(p.i - v.i)) * (1 - std::abs(p.j - v.j)) * (1 - std::abs(p.k - v.k)) *
                   tissue.valueOr(v, 255) / 255.0;
        }
        return sum;
    };
    double off_mm = 0;
    while (off_mm < 15 && at(off_mm) >= 0.5)
        off_mm += kStep_mm;
    return off_mm;
}

struct Polyp {
    double width_mm, height_mm, noise_hu;
};

class Polyps : public testing::TestWithParam<Polyp> {};

/// Half an ellipsoid on a flat wall in gas.
TEST_P(Polyps, KeepTheirDiameterAndHeightWhateverTheNoise)
{
    const auto [width_mm, height_mm, noise_hu] = GetParam();
    const double radius_mm = width_mm / 2, wall_mm = -5;
    const auto isTissue = [&](Point3 p) {
        const double up = (p.z - wall_mm) / height_mm;
        return p.z < wall_mm || (p.x * p.x + p.y * p.y) / (radius_mm * radius_mm) + up * up < 1;
    };
    const Scene scene(isTissue, 20, noise_hu);
    TissueVolume blurred(scene.grid);  // without noise and smoothing
    std::transform(scene.truth.voxels.begin(), scene.truth.voxels.end(), blurred.voxels.begin(),
                   [](float s) { return std::uint8_t(std::lround(255 * s)); });
    const TissueVolume found = scene.find(noise_hu).tissue;
    const auto heightIn = [&](const TissueVolume& tissue) { return toWall_mm(tissue, {0, 0, wall_mm - 2}, {0, 0, 1}); };
    const auto diameterIn = [&](const TissueVolume& tissue) {
        constexpr int kDirections = 16;
        double sum = 0;
        for (int n = 0; n < kDirections; ++n) {
            const double turn = 2 * std::numbers::pi * n / kDirections;
            sum += toWall_mm(tissue, {0, 0, wall_mm + height_mm / 2}, {std::cos(turn), std::sin(turn), 0});
        }
        return 2 * sum / kDirections;
    };
    EXPECT_NEAR(diameterIn(found), diameterIn(blurred), 0.3);
    EXPECT_NEAR(heightIn(found), heightIn(blurred), 0.1 * height_mm);
}

INSTANTIATE_TEST_SUITE_P(OnTheWall, Polyps,
                         testing::Values(Polyp{5, 2.5, 10}, Polyp{5, 2.5, 40}, Polyp{5, 2.5, 80}, Polyp{6, 6, 40},
                                         Polyp{8, 2, 40}, Polyp{8, 2, 80}, Polyp{10, 5, 80}));

}  // namespace
}  // namespace vicon::steps

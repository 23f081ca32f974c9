#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tissue_scene.h"

namespace vicon::steps {
namespace {

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
    const TissueVolume blurred = scene.blurredTruth();
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

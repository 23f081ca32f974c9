#include "imaging.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vicon::phantom {
namespace {

HuVolume blockOf(int n, std::array<double, 3> spacing_mm)
{
    Grid grid;
    grid.size = {n, n, n};
    grid.spacing_mm = spacing_mm;
    return HuVolume(grid, 0);
}

HuVolume imaged(const HuVolume& scene, const ImagingOptions& options)
{
    NoProgress progress;
    return imageScene(scene, options, progress);
}

TEST(Imaging, BlursAnEdgeByThePointSpreadInEveryDirection)
{
    // Fine voxels: the averaging over a voxel adds little to sigma.
    constexpr double kSigma = 0.7;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        HuVolume scene = blockOf(32, {0.25, 0.25, 0.25});
        for (std::size_t v = 0; v < scene.voxels.size(); ++v) {
            const Index3 at = scene.grid.indexOf(v);
            const int n[3] = {at.i, at.j, at.k};
            scene.voxels[v] = n[axis] < 16 ? 0 : 1000;
        }
        const HuVolume out = imaged(scene, {1, kSigma, 0});
        for (int n = 8; n < 24; ++n) {
            int at[3] = {16, 16, 16};
            at[axis] = n;
            const double away_mm = (n - 15.5) * 0.25;
            EXPECT_NEAR(out.at({at[0], at[1], at[2]}), 500 * (1 + std::erf(away_mm / kSigma / std::sqrt(2.0))), 12)
                << "axis " << axis << " at " << n;
        }
    }
}

TEST(Imaging, AddsNoiseOfTheStatedDeviationInTheMiddle)
{
    for (const double blur_mm : {0.05, 0.5, 0.8}) {
        const HuVolume out = imaged(blockOf(96, {0.74, 0.74, 1}), {1, blur_mm, 25});
        double sum = 0, squares = 0, neighbours = 0;
        int count = 0;
        for (int k = 24; k < 72; ++k)
            for (int j = 36; j < 60; ++j)
                for (int i = 36; i < 60; ++i, ++count) {
                    const double v = out.at({i, j, k});
                    sum += v;
                    squares += v * v;
                    neighbours += v * out.at({i + 1, j, k});
                }
        EXPECT_NEAR(sum / count, 0, 1) << blur_mm;
        EXPECT_NEAR(std::sqrt(squares / count), 25, 2) << blur_mm;
        EXPECT_GT(neighbours / squares, 0.25) << "filtered noise is correlated; blur " << blur_mm;
    }
}

TEST(Imaging, LeavesPaddingAlone)
{
    HuVolume scene = blockOf(16, {1, 1, 1});
    scene.at({3, 4, 5}) = kPaddingHu;
    const HuVolume out = imaged(scene, {1, 0.7, 30});
    for (std::size_t v = 0; v < out.voxels.size(); ++v)
        EXPECT_EQ(out.voxels[v] == kPaddingHu, scene.voxels[v] == kPaddingHu);
}

}  // namespace
}  // namespace vicon::phantom

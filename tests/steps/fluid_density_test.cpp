// The density of tagged fluid, place by place.
#include "tissue/fluid_density.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vicon/steps/tissue.h"

namespace vicon::steps {
namespace {

constexpr int kFluidHu = 700, kSedimentHu = 1400;
constexpr double kNoise_hu = 10;

TEST(FluidDensity, InSedimentIsThatOfWhatLiesOnBothSides)
{
    // Two voxels of sediment on the floor of a pool.
    const InsideVolume inside(Grid{.size = {24, 24, 24}}, kFluid);
    HuVolume hu(inside.grid, kFluidHu);
    for (std::size_t n = 0; n < hu.voxels.size(); ++n)
        if (hu.grid.indexOf(n).j >= 22)
            hu.voxels[n] = kSedimentHu;
    const Mixture mixture(hu, inside, {});
    const FluidDensity density(mixture, kNoise_hu, TissueOptions{}.tag_contrast_hu);
    EXPECT_NEAR(density.at({12, 10, 12}), kFluidHu, 1);
    EXPECT_NEAR(density.besides({12, 10, 12}), kFluidHu, 1);
    // Sediment on one side alone: fluid lies there.
    EXPECT_NEAR(density.besides({12, 20, 12}), kFluidHu, 1);
    // In it: less what a kernel overshoots, and noise.
    EXPECT_NEAR(density.besides({12, 22, 12}), kSedimentHu - 0.1 * kFluidHu - 4 * kNoise_hu, 1);
}

TEST(FluidDensity, InAThinFoldWithSedimentOnOneSideLiesBetweenBothSides)
{
    // On ctc-prone a fold in the caecum was torn there: it is nearly as dense as the fluid on its other side.
    constexpr int kFoldHu = 560;
    const InsideVolume inside(Grid{.size = {24, 24, 24}}, kFluid);
    HuVolume hu(inside.grid, kFluidHu);
    for (std::size_t n = 0; n < hu.voxels.size(); ++n) {
        const Index3 v = hu.grid.indexOf(n);
        if ((v.i == 12 || v.i == 13) && v.j >= 20)
            hu.voxels[n] = kSedimentHu;
        if (v.i == 11 && v.j >= 8)
            hu.voxels[n] = kFoldHu;
    }
    const Mixture mixture(hu, inside, {});
    const FluidDensity density(mixture, kNoise_hu, TissueOptions{}.tag_contrast_hu);
    EXPECT_GT(density.besides({11, 22, 12}), density.at({11, 22, 12}) + 80);
    EXPECT_LT(density.besides({11, 22, 12}), (kFluidHu + kSedimentHu) / 2);
    for (const Index3 beside : {Index3{11, 14, 12}, Index3{9, 22, 12}})
        EXPECT_NEAR(density.besides(beside), density.at(beside), 1) << beside.i;
}

TEST(FluidDensity, OfAPoolIsNotThatOfTheFaintFoldInIt)
{
    const InsideVolume inside(Grid{.size = {24, 24, 24}}, kFluid);
    HuVolume hu(inside.grid, kFluidHu);
    for (std::size_t n = 0; n < hu.voxels.size(); ++n)
        if (const int off = std::abs(hu.grid.indexOf(n).i - 12); off < 2)
            hu.voxels[n] = std::int16_t(off == 0 ? 380 : 560);
    const Mixture mixture(hu, inside, {});
    const FluidDensity density(mixture, kNoise_hu, TissueOptions{}.tag_contrast_hu);
    EXPECT_NEAR(density.at({12, 12, 12}), kFluidHu, 1);
}

TEST(FluidDensity, OfPoolsBehindAWallAreEachItsOwn)
{
    InsideVolume inside(Grid{.size = {40, 20, 20}}, kFluid);
    HuVolume hu(inside.grid, kFluidHu);
    for (std::size_t n = 0; n < hu.voxels.size(); ++n) {
        const int i = hu.grid.indexOf(n).i;
        if (i >= 19 && i < 21)
            inside.voxels[n] = kOutside;
        if (i >= 20)
            hu.voxels[n] = 400;
    }
    const Mixture mixture(hu, inside, {});
    const FluidDensity density(mixture, kNoise_hu, TissueOptions{}.tag_contrast_hu);
    EXPECT_NEAR(density.at({8, 10, 10}), kFluidHu, 5);
    EXPECT_NEAR(density.at({32, 10, 10}), 400, 5);
}

TEST(FluidDensity, OfAPoolThatGrowsDenserIsRightEverywhereInIt)
{
    constexpr double kRise_hu = 6;  // a voxel
    for (int axis = 0; axis < 3; ++axis) {
        const InsideVolume inside(Grid{.size = {40, 40, 40}}, kFluid);
        HuVolume hu(inside.grid);
        const auto along = [&](Index3 v) { return axis == 0 ? v.i : axis == 1 ? v.j : v.k; };
        for (std::size_t n = 0; n < hu.voxels.size(); ++n)
            hu.voxels[n] = std::int16_t(std::lround(500 + kRise_hu * along(hu.grid.indexOf(n))));
        const Mixture mixture(hu, inside, {});
        const FluidDensity density(mixture, kNoise_hu, TissueOptions{}.tag_contrast_hu);
        for (int n = 16; n < 25; ++n)  // far from the pool's ends, where the mean is one-sided
            EXPECT_NEAR(density.at({n, n, n}), 500 + kRise_hu * n, 3) << axis << " " << n;
    }
}

TEST(FluidDensity, OfWhatIsHardlyBrighterThanTissueIsNone)
{
    const InsideVolume inside(Grid{.size = {24, 24, 24}}, kFluid);
    const HuVolume hu(inside.grid, 100);
    const Mixture mixture(hu, inside, {});
    const FluidDensity density(mixture, kNoise_hu, TissueOptions{}.tag_contrast_hu);
    EXPECT_EQ(density.at({12, 12, 12}), 0);
    EXPECT_EQ(density.besides({12, 12, 12}), 0);
}

}  // namespace
}  // namespace vicon::steps

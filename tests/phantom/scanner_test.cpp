// What scanner and protocol make of the same patient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scans.h"

namespace vicon::phantom {
namespace {

PhantomOptions quietOptions()
{
    PhantomOptions options = smallOptions(3);
    options.size = {192, 192, 162};
    options.noise_hu = 0;
    return options;
}

/// Deviation in a box of soft tissue about a point.
double deviationAt(const HuVolume& hu, Point3 p)
{
    const Index3 at = hu.grid.indexAt(p);
    double sum = 0, squares = 0;
    int count = 0;
    for (int k = -2; k <= 2; ++k)
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i, ++count) {
                const double v = hu.at({at.i + i, at.j + j, at.k + k});
                sum += v;
                squares += v * v;
            }
    return std::sqrt(squares / count - sum / count * (sum / count));
}

TEST(Scanner, MakesTaggingAsDenseAsAskedFor)
{
    PhantomOptions options = quietOptions();
    const PhantomScan usual = scanOf(options);
    options.protocol.tagging_hu = 1200;
    const PhantomScan dense = scanOf(options);
    EXPECT_EQ(dense.truth.inside.voxels, usual.truth.inside.voxels);
    ASSERT_FALSE(dense.truth.pools.empty());
    for (const FluidPool& pool : dense.truth.pools)
        EXPECT_EQ(pool.density_hu, 1200);
    const auto count = [](const PhantomScan& scan) {
        return std::count_if(scan.hu.voxels.begin(), scan.hu.voxels.end(), [](std::int16_t v) { return v > 1000; });
    };
    EXPECT_EQ(count(usual), 0);
    EXPECT_GT(count(dense), 100);
}

TEST(Scanner, WithASharpKernelOvershootsAtEdges)
{
    // Deep gas and the middle of the liver stay as they are; beside skin and lumen the densities swing.
    PhantomOptions options = quietOptions();
    options.blur_mm = 3;
    const PhantomScan usual = scanOf(options);
    options.protocol.kernel = Kernel::sharp;
    const PhantomScan sharp = scanOf(options);
    const Point3 liver{-72, -14, 352};
    EXPECT_NEAR(sharp.hu.at(sharp.hu.grid.indexAt(liver)), usual.hu.at(usual.hu.grid.indexAt(liver)), 3);
    double furthest_hu = 0;
    for (std::size_t n = 0; n < sharp.hu.voxels.size(); ++n)
        if (usual.truth.inside.voxels[n] == kGas)
            furthest_hu = std::max(furthest_hu, double(usual.hu.voxels[n] - sharp.hu.voxels[n]));
    EXPECT_GT(furthest_hu, 50) << "darker in gas beside the wall";
}

TEST(Scanner, AveragesThickSlicesAndKeepsTheTruthOnThinOnes)
{
    PhantomOptions options = quietOptions();
    options.protocol.thickness_mm = 3;
    const PhantomScan scan = scanOf(options);
    EXPECT_NEAR(scan.hu.grid.spacing_mm[2], 3, 1e-9);
    EXPECT_EQ(scan.hu.grid.size[2], 143);
    EXPECT_NEAR(scan.truth.inside.grid.spacing_mm[2], 1, 1e-9);
    // Each slice stands in the middle of the three that it is the mean of.
    for (const int k : {0, 71, 142}) {
        const Point3 thick = scan.hu.grid.pointAt(Index3{50, 60, k});
        const Point3 thin = scan.truth.inside.grid.pointAt(Index3{50, 60, 3 * k + 1});
        EXPECT_NEAR(distance(thick, thin), 0, 1e-6) << k;
    }
    int counted = 0, wrong = 0;
    for (std::size_t n = 0; n < scan.hu.voxels.size(); ++n) {
        const Index3 v = scan.hu.grid.indexOf(n);
        int gas = 0;
        for (int m = 0; m < 3; ++m)
            gas += scan.truth.inside.at({v.i, v.j, 3 * v.k + m}) == kGas;
        if (gas == 3) {
            ++counted;
            wrong += scan.hu.voxels[n] > -400;
        }
    }
    EXPECT_GT(counted, 1000);
    EXPECT_LT(wrong, counted / 20);
}

TEST(Scanner, AddsTheNoiseThatIsAskedForToThickSlicesToo)
{
    const Point3 muscle{-88, 70, 60};
    for (const double thickness_mm : {0.0, 3.0}) {
        PhantomOptions options = quietOptions();
        options.noise_hu = 30;
        options.protocol.thickness_mm = thickness_mm;
        EXPECT_NEAR(deviationAt(scanOf(options).hu, muscle), 27, 9) << thickness_mm;
    }
}

TEST(Scanner, FloatsBubblesOfGasInThePools)
{
    PhantomOptions options = quietOptions();
    const PhantomScan without = scanOf(options);
    options.protocol.bubbles = 40;
    const PhantomScan scan = scanOf(options);
    ASSERT_GE(scan.truth.bubbles.size(), 20U);
    double bubbles_ml = 0;
    for (const GasBubble& bubble : scan.truth.bubbles) {
        EXPECT_GE(bubble.diameter_mm, 2);
        EXPECT_LE(bubble.diameter_mm, 6);
        bubbles_ml += 3.14159 / 6 * std::pow(bubble.diameter_mm, 3) / 1000;
    }
    double turned_ml = 0;
    for (std::size_t n = 0; n < scan.truth.inside.voxels.size(); ++n) {
        const std::uint8_t before = without.truth.inside.voxels[n], now = scan.truth.inside.voxels[n];
        ASSERT_EQ(before != kOutside, now != kOutside) << "the lumen is the same";
        turned_ml += before == kFluid && now == kGas ? scan.truth.inside.grid.voxelVolume_mm3() / 1000 : 0;
    }
    EXPECT_GT(turned_ml, 0.3 * bubbles_ml);
    EXPECT_LT(turned_ml, 1.1 * bubbles_ml);
}

TEST(Scanner, ShowsContrastMediumInTheWallAndNotInTheMuscles)
{
    PhantomOptions options = quietOptions();
    const PhantomScan without = scanOf(options);
    options.protocol.contrast = true;
    const PhantomScan scan = scanOf(options);
    const auto added_hu = [&](Point3 p) {
        const Index3 v = scan.hu.grid.indexAt(p);
        return scan.hu.at(v) - without.hu.at(v);
    };
    EXPECT_NEAR(added_hu({-72, -14, 352}), 55, 5) << "liver";
    EXPECT_NEAR(added_hu({-88, 70, 60}), 0, 2) << "gluteal muscles";
    EXPECT_EQ(scan.truth.inside.voxels, without.truth.inside.voxels);
    for (const Polyp& polyp : scan.truth.polyps)
        if (polyp.diameter_mm > 8) {
            EXPECT_GT(added_hu(polyp.position_mm), 25) << polyp.station_mm;
        }
}

TEST(Scanner, StreaksFromHipToHipAndStarvesBehindMetal)
{
    PhantomOptions options = quietOptions();
    const PhantomScan quiet = scanOf(options);
    options.protocol.hips = Hips::streaks;
    const PhantomScan streaked = scanOf(options);
    options.protocol.hips = Hips::metal;
    const PhantomScan metal = scanOf(options);
    HuVolume added = streaked.hu;
    for (std::size_t n = 0; n < added.voxels.size(); ++n)
        added.voxels[n] = std::int16_t(added.voxels[n] - quiet.hu.voxels[n]);
    EXPECT_GT(deviationAt(added, {40, 4, 46}), 12) << "between the hips";
    EXPECT_LT(deviationAt(added, {0, -60, 75}), deviationAt(added, {40, 4, 46}) / 2) << "above them";
    EXPECT_EQ(deviationAt(added, {-72, -14, 352}), 0);
    EXPECT_EQ(*std::max_element(metal.hu.voxels.begin(), metal.hu.voxels.end()), 3071);
    const auto mean_hu = [](const PhantomScan& scan, Point3 p) {
        const Index3 at = scan.hu.grid.indexAt(p);
        double sum = 0;
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i)
                sum += scan.hu.at({at.i + i, at.j + j, at.k}) / 25.0;
        return sum;
    };
    EXPECT_LT(mean_hu(metal, {-70, 4, 46}), mean_hu(quiet, {-70, 4, 46}) - 60) << "a dark band between the hips";
}

}  // namespace
}  // namespace vicon::phantom

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tissue_scene.h"

namespace vicon::steps {
namespace {

/// A lumen 20 mm wide, with a sheet of tissue across it.
Scene withSheet(double thick_mm, double level_mm, double noise_hu)
{
    return Scene([=](Point3 p) { return std::abs(p.x) < thick_mm / 2 || std::abs(p.x) > 12 || std::abs(p.y) > 12; },
                 level_mm, noise_hu);
}

/// Part of the sheet's middle that is wall.
double shareKept(const Scene& scene, const InsideVolume& lumen)
{
    int kept = 0, all = 0;
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (std::abs(p.x) < kVoxel_mm && std::abs(p.y) < 9 && std::abs(p.z) < 10) {
            // On the two layers of voxels beside the middle: one of them, in each line across, must be wall.
            if (p.x < 0)
                continue;
            Index3 v = scene.grid.indexOf(n);
            const bool here = lumen.at(v) == kOutside;
            --v.i;
            kept += here || lumen.at(v) == kOutside ? 1 : 0;
            ++all;
        }
    }
    return double(kept) / all;
}

/// With the sheet's own label gone where blur left it no half-way density, as a mask by density has it.
InsideVolume labelsByDensity(const Scene& scene, double level_mm)
{
    InsideVolume inside = scene.inside;
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (std::abs(p.x) < 4 && std::abs(p.y) < 11)
            inside.voxels[n] = p.y > level_mm ? (scene.hu.voxels[n] > (kTissueHu + kFluidHu) / 2 ? kFluid : kOutside)
                                              : (scene.hu.voxels[n] < -480 ? kGas : kOutside);
    }
    return inside;
}

struct SheetCase {
    const char* name;
    double thick_mm, level_mm, noise_hu;
};
class Sheets : public testing::TestWithParam<SheetCase> {};

TEST_P(Sheets, StayWholeHoweverMuchBlurTakesFromThem)
{
    const auto [name, thick_mm, level_mm, noise_hu] = GetParam();
    Scene scene = withSheet(thick_mm, level_mm, noise_hu);
    scene.inside = labelsByDensity(scene, level_mm);
    const TissueResult result = scene.find(std::max(noise_hu, 15.0));
    EXPECT_GT(shareKept(scene, result.lumen), 0.99) << name;
}

INSTANTIATE_TEST_SUITE_P(Thin, Sheets,
                         testing::Values(SheetCase{"gas", 1.5, 20, 0}, SheetCase{"gas, thinner than half", 0.8, 20, 0},
                                         SheetCase{"gas, noise", 1, 20, 30}, SheetCase{"fluid", 1.5, -20, 0},
                                         SheetCase{"fluid, thinner than half", 0.8, -20, 0},
                                         SheetCase{"fluid, half", 1.2, -20, 20},
                                         SheetCase{"through the level", 2, 0.1, 0},
                                         SheetCase{"through the level, noise", 2, 0.1, 30}),
                         [](const auto& info) { return std::to_string(info.index); });

TEST(Tissue, RidgesWithTissueBetweenThemAreNoSheets)
{
    // As high as a fold of 1.3 mm; what lies between them holds half of that.
    const Scene scene(
        [](Point3 p) {
            const double from = std::abs(p.x) / 2.7;
            return std::abs(p.x) > 14 || (std::abs(p.x) < 8 && std::abs(from - std::round(from)) < 0.25);
        },
        20);
    EXPECT_LT(scene.find().found.at("sheet_voxels"), 100);
}

TEST(Tissue, NoiseOnAWallIsNoSheet)
{
    for (const double noise_hu : {30.0, 60.0}) {
        const Scene scene([](Point3 p) { return std::abs(p.x) > 8; }, 20, noise_hu);
        EXPECT_EQ(scene.find(noise_hu).found.at("sheet_voxels"), 0) << noise_hu;
    }
}

/// Noise of a smooth kernel: neighbouring voxels are alike, as where thick slices are resampled.
std::vector<double> smoothNoise(const Grid& grid, double noise_hu, unsigned seed)
{
    constexpr double kLeft = 0.2296;  // of white noise, after a binomial mean along each axis
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise_hu / kLeft);
    std::vector<double> noise(grid.voxelCount());
    for (double& one : noise)
        one = normal(random);
    std::size_t stride = 1;
    for (const int length : grid.size) {
        const std::vector<double> before = noise;
        for (std::size_t n = 0; n < noise.size(); ++n) {
            const auto at = int(n / stride % std::size_t(length));
            noise[n] =
                before[n] / 2 + before[at > 0 ? n - stride : n] / 4 + before[at + 1 < length ? n + stride : n] / 4;
        }
        stride *= std::size_t(length);
    }
    return noise;
}

/// A pool of 300 HU: of the fraction there, noise makes four times as much as beside gas.
Scene inFaintFluid(const Scene::IsTissue& isTissue, double noise_hu, unsigned seed = 11)
{
    constexpr double kFaintHu = 300;
    Scene scene(isTissue, -20);
    const std::vector<double> noise = smoothNoise(scene.grid, noise_hu, seed);
    for (std::size_t n = 0; n < noise.size(); ++n)
        scene.hu.voxels[n] = std::int16_t(
            std::lround(scene.hu.voxels[n] - (1 - scene.truth.voxels[n]) * (kFluidHu - kFaintHu) + noise[n]));
    return scene;
}

/// Where a fold ends in such a pool, noise went on with it in shards: 129 voxels of them.
TEST(Tissue, NoiseInFaintFluidIsNoSheet)
{
    constexpr double kNoise_hu = 50;
    int shards = 0, lost = 0, fold = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const Scene scene = inFaintFluid(
            [](Point3 p) { return (std::abs(p.x) < 1 && p.y < 0) || std::abs(p.x) > 14 || std::abs(p.y) > 14; },
            kNoise_hu, seed);
        scene.forEach(scene.find(kNoise_hu).tissue, 3, [&](Point3, double fraction, double truth) {
            shards += truth < 0.02 && fraction > 0.5;
            fold += truth > 0.6;
            lost += truth > 0.6 && fraction < 0.5;
        });
    }
    EXPECT_LT(shards, 80);
    EXPECT_LT(lost, fold * 0.14);  // noise takes an eighth, with shards and without
}

TEST(Tissue, AFoldInFaintNoisyFluidStaysWhole)
{
    const Scene scene =
        inFaintFluid([](Point3 p) { return std::abs(p.x) < 1 || std::abs(p.x) > 12 || std::abs(p.y) > 12; }, 50);
    EXPECT_GT(shareKept(scene, scene.find(50).lumen), 0.97);
}

TEST(Tissue, AFoldInSedimentStaysWhole)
{
    // Contrast medium settled to twice the density of what stands over it, with a fold of 2 mm in it.
    Scene scene([](Point3 p) { return std::abs(p.y) > 13 || std::abs(p.z) > 13 || std::abs(p.x) < 1; }, -20);
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const double over_mm = scene.grid.pointAt(scene.grid.indexOf(n)).y - 9;
        if (over_mm > 0)
            scene.hu.voxels[n] = std::int16_t(
                std::lround(scene.hu.voxels[n] + (1 - scene.truth.voxels[n]) * kFluidHu * std::min(1.0, over_mm / 2)));
    }
    const TissueResult found = scene.find();
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (std::abs(p.x) < 0.4 && p.y > -10 && p.y < 12 && std::abs(p.z) < 10) {
            EXPECT_GE(found.tissue.voxels[n], 128) << p.y << " " << p.z;
        }
    }
}

TEST(Tissue, AThickFoldWithSedimentOnOneSideKeepsItsWidth)
{
    constexpr double kThick_mm = 4;
    Scene scene([](Point3 p) { return std::abs(p.y) > 13 || std::abs(p.z) > 13 || std::abs(p.x) < kThick_mm / 2; },
                -20);
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        const double sediment = std::erfc((p.x + kThick_mm / 2) / (std::sqrt(2) * kSigma_mm)) / 2;
        if (std::abs(p.y) < 11 && std::abs(p.z) < 11)
            scene.hu.voxels[n] = std::int16_t(
                std::lround(scene.hu.voxels[n] + sediment * kFluidHu * std::clamp((p.y - 4) / 2, 0.0, 1.0)));
    }
    double sum = 0, truth_sum = 0;
    scene.forEach(scene.find().tissue, 6, [&](Point3 p, double fraction, double truth) {
        sum += p.y > 6 ? fraction : 0;
        truth_sum += p.y > 6 ? truth : 0;
    });
    EXPECT_NEAR(kThick_mm * sum / truth_sum, kThick_mm, 0.1);
}

}  // namespace
}  // namespace vicon::steps

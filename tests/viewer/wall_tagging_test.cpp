// Where tagging touches the wall, by densities before a plane wall at x = 0 with the lumen above.
#include "vicon/viewer/model/wall_tagging.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "vicon/core/volume.h"

namespace vicon::viewer {
namespace {

constexpr double kBlur_mm = 0.7;
constexpr double kGas_hu = -1000, kTissue_hu = 40, kTagged_hu = 600;

/// Layers along x, each up to where the next begins, blurred.
struct Layer {
    double to_mm, hu;
};
double densityAt(double x, const std::vector<Layer>& layers)
{
    double hu = 0, below = 0;
    for (const Layer& layer : layers) {
        const double share = 0.5 * (1 + std::erf((layer.to_mm - x) / (kBlur_mm * std::numbers::sqrt2)));
        hu += layer.hu * (share - below);
        below = share;
    }
    return hu;
}

constexpr double kEnd_mm = 1000;

struct Wall {
    explicit Wall(const std::vector<Layer>& layers, double noise_hu = 0, double lumen_to_mm = kEnd_mm)
    {
        Grid grid;
        grid.size = {60, 24, 24};
        grid.spacing_mm = {0.75, 0.75, 0.75};
        grid.origin_mm = {-15, 0, 0};
        volume = HuVolume(grid);
        inside = InsideVolume(grid);
        std::mt19937 random(1);
        std::normal_distribution<double> noise(0, 1);
        for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
            const double x = grid.pointAt(grid.indexOf(n)).x;
            volume.voxels[n] = std::int16_t(std::lround(densityAt(x, layers) + noise_hu * noise(random)));
            inside.voxels[n] = x > 0 && x < lumen_to_mm ? 1 : 0;
        }
    }

    /// Of points all over the wall.
    std::vector<float> tagging(double noise_hu = 0, const TagDensities& densities = {}) const
    {
        std::vector<float> points_mm, normals;
        for (double y = 2; y < 15; y += 0.5)
            for (double z = 2; z < 15; z += 0.5) {
                points_mm.insert(points_mm.end(), {0.F, float(y), float(z)});
                normals.insert(normals.end(), {1.F, 0.F, 0.F});
            }
        return taggingOf(points_mm, normals, volume, inside, noise_hu, densities);
    }

    HuVolume volume;
    InsideVolume inside;
};

void expectAll(const std::vector<float>& tagging, double from, double to)
{
    ASSERT_FALSE(tagging.empty());
    const auto [least, most] = std::ranges::minmax(tagging);
    EXPECT_GE(least, from);
    EXPECT_LE(most, to);
}

TEST(WallTagging, IsNoneBeforeGas)
{
    expectAll(Wall({{0, kTissue_hu}, {kEnd_mm, kGas_hu}}).tagging(), 0, 0);
}

TEST(WallTagging, IsAllUnderAPool)
{
    expectAll(Wall({{0, kTissue_hu}, {kEnd_mm, kTagged_hu}}).tagging(), 1, 1);
}

TEST(WallTagging, IsSeenInAFilmAsThickAsThoseOnFlatLesions)
{
    expectAll(Wall({{0, kTissue_hu}, {1.5, kTagged_hu}, {kEnd_mm, kGas_hu}}).tagging(), 0.7, 1);
}

TEST(WallTagging, IsNotTheBoneBehindTheWallNorThePoolBehindTheNextOne)
{
    expectAll(Wall({{-2.5, 1200}, {0, kTissue_hu}, {kEnd_mm, kGas_hu}}).tagging(), 0, 0);
    expectAll(Wall({{0, kTissue_hu}, {1.5, kGas_hu}, {2.25, kTissue_hu}, {kEnd_mm, kTagged_hu}}, 0, 1.5).tagging(), 0,
              0);
}

TEST(WallTagging, IsNotMucosaWithContrastMedium)
{
    expectAll(Wall({{-3, kTissue_hu}, {0, 140}, {kEnd_mm, kGas_hu}}).tagging(), 0, 0);
}

TEST(WallTagging, BeginsWhereTheScansOptionsHadIt)
{
    const std::vector<StepRecord> steps{
        {.step = "segment", .parameters = {{"segment.tissue_hu", 60.0}}, .result = {}, .finished = {}},
        {.step = "tissue",
         .parameters = {{"segment.tissue_hu", 60.0}, {"tissue.tag_contrast_hu", 700.0}},
         .result = {},
         .finished = {}}};
    const Wall pool({{0, kTissue_hu}, {kEnd_mm, kTagged_hu}});
    expectAll(pool.tagging(0, tagDensitiesOf(steps)), 0, 0);
    expectAll(pool.tagging(0, tagDensitiesOf({})), 1, 1);
}

TEST(WallTagging, IsNotMadeOfNoise)
{
    const Wall bare({{0, kTissue_hu}, {kEnd_mm, kGas_hu}}, 60);
    expectAll(bare.tagging(60), 0, 0);
}

TEST(WallTagging, IsMoreBesideMottledBlocksAndNotWhereNoneTouchesTheWall)
{
    const std::vector<float> points_mm{0, 0, 0, 6, 0, 0, 12, 0, 0, 0, 5, 0, 0, 1, 0, 4.5F, 0, 0};
    std::vector<float> tagging{1, 1, 1, 0, 0, 0.5F};
    addUntrusted(tagging, points_mm, {{.block_mm = 4, .blocks_mm = {{0, 0, 3}, {-40, 7, 0}}, .shares = {1, 1}}, {}});
    EXPECT_EQ(tagging, (std::vector<float>{2, 2, 1, 0, 2, 1.5F}));
}

TEST(WallTagging, IsMostOnAFaintWallAndItsRim)
{
    const std::vector<float> points_mm{0, 0, 0, 2.9F, 0, 0, 3.1F, 0, 0};
    std::vector<float> tagging{0, 0.5F, 0.5F};
    addUntrusted(tagging, points_mm, {{}, {{{0, 0, 0}, std::numbers::pi}}});
    EXPECT_EQ(tagging, (std::vector<float>{2, 2, 0.5F}));
}

}  // namespace
}  // namespace vicon::viewer

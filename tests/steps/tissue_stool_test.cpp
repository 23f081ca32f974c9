// Tagged stool on a wall across x, gas before it and no fluid level anywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "tissue_scene.h"

namespace vicon::steps {
namespace {

constexpr double kWallAt_mm = 4;  // tissue from here on

using Shape = std::function<bool(Point3)>;

Shape ball(Point3 middle, double radius_mm)
{
    return [=](Point3 p) { return distance(p, middle) < radius_mm; };
}

bool behindWall(Point3 p)
{
    return p.x > kWallAt_mm;
}

/// With stool as bright as the scenes' fluid; the labels know gas alone, as segmentation has it.
Scene sceneWithStool(const Shape& is_tissue, const Shape& is_stool, Vector3 down = kDown, double noise_hu = 20)
{
    constexpr double kNever_mm = 1e9;
    Scene scene(is_tissue, Level([=](Point3 p) { return is_stool(p) ? -kNever_mm : kNever_mm; }), noise_hu, 48, down);
    for (std::size_t n = 0; n < scene.inside.voxels.size(); ++n)
        scene.inside.voxels[n] = scene.hu.voxels[n] < (kGasHu + kTissueHu) / 2 ? kGas : kOutside;
    return scene;
}

/// Part of what a shape holds, away from the ends of the scan, that is lumen.
double shareInLumen(const Scene& scene, const InsideVolume& lumen, const Shape& shape)
{
    int inside = 0, all = 0;
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        if (!shape(scene.grid.pointAt(scene.grid.indexOf(n))))
            continue;
        ++all;
        inside += lumen.voxels[n] != kOutside ? 1 : 0;
    }
    return double(inside) / all;
}

int lumps(const TissueResult& result)
{
    return result.found.at("stool_lumps").get<int>();
}

Shape onWall(const Shape& shape)
{
    return [=](Point3 p) { return shape(p) && !behindWall(p); };
}

struct Side {
    const char* name;
    Vector3 down;
};

class StoolOnAnySide : public testing::TestWithParam<Side> {};

TEST_P(StoolOnAnySide, IsTakenOutAndTheWallUnderItIsFound)
{
    const Shape lump = onWall(ball({1.5, 0, 0}, 4.5));
    const Scene scene = sceneWithStool(behindWall, lump, GetParam().down);
    const TissueResult result = scene.find();
    EXPECT_EQ(lumps(result), 1);
    EXPECT_GT(shareInLumen(scene, result.lumen, lump), 0.95);
    for (const double off_mm : {-2.0, 0.0, 2.0})
        EXPECT_NEAR(toWall_mm(result.tissue, {9, off_mm, off_mm / 2}, {-1, 0, 0}), 9 - kWallAt_mm, 0.35) << off_mm;
    const double lump_ml = 4.0 / 3 * 3.14159 * std::pow(4.5, 3) / 1000 * 0.85;  // the wall cuts off 15 %
    EXPECT_NEAR(result.untrusted.mottled.volume_ml(), lump_ml, 0.25 * lump_ml);
}

INSTANTIATE_TEST_SUITE_P(Of, StoolOnAnySide,
                         testing::Values(Side{"floor", {1, 0, 0}}, Side{"ceiling", {-1, 0, 0}},
                                         Side{"side", {0, 1, 0}}),
                         [](const auto& info) { return info.param.name; });

TEST(Stool, WithAirInItIsTakenOutInPartAndToldAsAWhole)
{
    const Shape lump = onWall(ball({0, 0, 0}, 6));
    const Shape bubbles = [](Point3 p) {
        const auto off = [](double mm) { return mm - 4 * std::round(mm / 4); };
        return std::hypot(off(p.x), off(p.y), off(p.z)) < 1.2;
    };
    const Scene scene = sceneWithStool(behindWall, [=](Point3 p) { return lump(p) && !bubbles(p); });
    const TissueResult result = scene.find();
    EXPECT_GT(shareInLumen(scene, result.lumen, lump), 0.7);
    EXPECT_GT(result.untrusted.mottled.volume_ml(), 0.5 * 0.9 * 4.0 / 3 * 3.14159 * 0.216);
    for (const Point3& block : result.untrusted.mottled.blocks_mm)
        EXPECT_LT(distance(block, Point3{}), 6 + 2 * result.untrusted.mottled.block_mm);
}

TEST(Stool, WhoseFlatTopPassedForALevelIsStool)
{
    const Shape lump = onWall(ball({1.5, 0, 0}, 4.5));
    Scene scene = sceneWithStool(behindWall, lump);
    for (std::size_t n = 0; n < scene.inside.voxels.size(); ++n)
        if (scene.hu.voxels[n] > (kTissueHu + kFluidHu) / 2)
            scene.inside.voxels[n] = kFluid;
    const TissueResult result = scene.find();
    EXPECT_EQ(lumps(result), 1);
    EXPECT_GT(shareInLumen(scene, result.lumen, lump), 0.95);
    EXPECT_NEAR(toWall_mm(result.tissue, {9, 0, 0}, {-1, 0, 0}), 9 - kWallAt_mm, 0.35);
}

TEST(Stool, IsNoPuddle)
{
    const Scene puddle([](Point3 p) { return std::hypot(p.x, p.z) > 6 + std::max(0.0, -p.y) || p.y > 4; }, 0.1, 20);
    EXPECT_EQ(lumps(puddle.find()), 0);
    EXPECT_EQ(puddle.find().untrusted.mottled.blocks_mm.size(), 0U);
}

TEST(Stool, OnAPolypLeavesThePolyp)
{
    const Shape polyp = ball({3, 0, 0}, 4);
    const Shape film = [=](Point3 p) { return ball({3, 0, 0}, 5.5)(p) && !polyp(p) && !behindWall(p); };
    const Scene scene = sceneWithStool([=](Point3 p) { return behindWall(p) || polyp(p); }, film);
    const TissueResult result = scene.find();
    EXPECT_EQ(lumps(result), 1);
    EXPECT_NEAR(toWall_mm(result.tissue, {9, 0, 0}, {-1, 0, 0}), 9 + 1, 0.75)
        << "its blur takes the film's own density from it";
    EXPECT_NEAR(toWall_mm(result.tissue, {1, 0, 0}, {0, 1, 0}), std::sqrt(16.0 - 4), 0.75);
}

TEST(Stool, IsNeitherBoneNorBowelBehindAWall)
{
    for (const double wall_mm : {1.5, 2.0, 3.0}) {
        const Scene scene = sceneWithStool([=](Point3 p) { return behindWall(p) && p.x < kWallAt_mm + wall_mm; },
                                           [=](Point3 p) { return p.x > kWallAt_mm + wall_mm; });
        EXPECT_EQ(lumps(scene.find()), 0) << wall_mm << " mm of wall";
    }
}

TEST(StoolWalls, StayWhereResidueLiesOnASeptum)
{
    for (const double thick_mm : {1.5, 2.0, 3.0}) {
        const double half_mm = thick_mm / 2;
        const Scene scene =
            sceneWithStool([=](Point3 p) { return std::abs(p.x) < half_mm; },
                           [=](Point3 p) { return p.x > half_mm && p.x < half_mm + 2.5 && std::hypot(p.y, p.z) < 5; });
        const TissueResult result = scene.find();
        EXPECT_EQ(lumps(result), 1) << thick_mm;
        int open = 0;
        for (int k = 8; k < 40; ++k)
            for (int j = 8; j < 40; ++j) {
                bool wall = false;
                for (int i = 16; i < 32; ++i)
                    wall = wall || result.lumen.at({i, j, k}) == kOutside;
                open += wall ? 0 : 1;
            }
        EXPECT_EQ(open, 0) << thick_mm << " mm: columns through the septum";
    }
}

}  // namespace
}  // namespace vicon::steps

#include <gtest/gtest.h>

#include "tissue_scene.h"

namespace vicon::steps {
namespace {

constexpr double kSlit_mm = 1.2;

/// Tagged bowel beside the colon, behind a wall of 1 mm; the labels hold it as far as this.
Scene withOtherBowel(double labelled_to_mm)
{
    Scene scene([](Point3 p) {
        const bool colon = p.x > -14 && p.x<2, other = p.x> 3 && p.x < 14 && p.y > 2;
        return !(colon || other) || std::abs(p.y) > 13 || std::abs(p.z) > 13;
    });
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (p.x > labelled_to_mm)
            scene.inside.voxels[n] = kOutside;
        // Where the wall is thinnest the labels go through it.
        if (p.x > 1 && p.x < 4 && p.y > 6 && p.y < 9 && std::abs(p.z) < 2)
            scene.inside.voxels[n] = kFluid;
    }
    return scene;
}

std::size_t labelledBeyond(const InsideVolume& inside, double x_mm)
{
    std::size_t count = 0;
    for (std::size_t n = 0; n < inside.grid.voxelCount(); ++n)
        count += inside.voxels[n] != kOutside && inside.grid.pointAt(inside.grid.indexOf(n)).x > x_mm;
    return count;
}

TEST(Tissue, BowelThatTheLabelsWereCutOffFromIsNoLumen)
{
    const Scene scene = withOtherBowel(8);
    const TissueResult found = scene.find();
    ASSERT_GT(labelledBeyond(scene.inside, 3), 1000U);
    EXPECT_EQ(labelledBeyond(found.lumen, 3), 0U);
    std::size_t lost = 0;
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n)
        lost += scene.truth.voxels[n] < 0.2 && scene.grid.pointAt(scene.grid.indexOf(n)).x < 1 &&
                scene.inside.voxels[n] != kOutside && found.lumen.voxels[n] == kOutside;
    EXPECT_EQ(lost, 0U) << "of the colon";
}

/// The colon, a slit in its wall, and what lies behind that; the labels end at `labelled_to_mm`.
Scene withSlit(const Scene::IsTissue& isBehind, double labelled_to_mm)
{
    Scene scene([&](Point3 p) {
        const bool colon = p.x > -14 && p.x < 2 && std::abs(p.y) < 13 && std::abs(p.z) < 13;
        const bool slit = p.x > 0 && p.x < 5 && std::abs(p.y - 8) < kSlit_mm / 2 && std::abs(p.z) < 2;
        return !(colon || slit || isBehind(p));
    });
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        const bool near_slit = std::abs(p.y - 8) < 1.5 && std::abs(p.z) < 2;
        if (p.x > labelled_to_mm || (p.x > 3 && !near_slit))
            scene.inside.voxels[n] = kOutside;
        else if (p.x > 1 && std::abs(p.y - 8) < kSlit_mm / 2 && std::abs(p.z) < 2)
            scene.inside.voxels[n] = kFluid;
    }
    return scene;
}

TEST(Tissue, ASliverOfOtherBowelBehindASlitIsNoLumen)
{
    const Scene scene =
        withSlit([](Point3 p) { return p.x > 4 && p.x < 14 && p.y > 2 && p.y < 13 && std::abs(p.z) < 13; }, 6);
    ASSERT_GT(labelledBeyond(scene.inside, 4), 20U);
    EXPECT_EQ(labelledBeyond(scene.find().lumen, 4), 0U);
}

TEST(Tissue, APuddleThatTheLabelsHoldTheMostOfStaysLumen)
{
    const Scene scene =
        withSlit([](Point3 p) { return p.x > 4 && p.x < 8 && std::abs(p.y - 8) < 1.5 && std::abs(p.z) < 2; }, 6);
    ASSERT_GT(labelledBeyond(scene.inside, 4), 20U);
    EXPECT_GE(labelledBeyond(scene.find().lumen, 4), labelledBeyond(scene.inside, 4));
}

TEST(Tissue, WhatHoldsGasIsNotTakenForOtherBowel)
{
    Scene scene = withOtherBowel(8);
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (p.x > 4 && p.x < 8 && p.y > 3 && p.y < 6 && std::abs(p.z) < 12) {
            scene.inside.voxels[n] = kGas;
            scene.hu.voxels[n] = std::int16_t(kGasHu);
        }
    }
    const TissueResult found = scene.find();
    EXPECT_GT(double(labelledBeyond(found.lumen, 4)), 0.5 * double(labelledBeyond(scene.inside, 4)));
}

TEST(Tissue, ARecessWithAWallOfItsOwnStaysLumen)
{
    const Scene scene = withOtherBowel(20);
    const TissueResult found = scene.find();
    EXPECT_GT(double(labelledBeyond(found.lumen, 3)), 0.95 * double(labelledBeyond(scene.inside, 3)));
}

}  // namespace
}  // namespace vicon::steps

// Where the labels end although the lumen goes on without a wall that the densities show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grid/run_labels.h"
#include "tissue_scene.h"

namespace vicon::steps {
namespace {

constexpr double kColon_mm = 7, kBowel_mm = 6;
constexpr double kFull = -100;  // a level above all: fluid alone

bool inColon(Point3 p)
{
    return std::hypot(p.y + 6, p.z) < kColon_mm;
}

/// Of the cross-section that the colon's labels leave out.
void labelColonAlone(Scene& scene)
{
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n)
        if (!inColon(scene.grid.pointAt(scene.grid.indexOf(n))))
            scene.inside.voxels[n] = kOutside;
}

/// Small bowel with tagging beside the colon, a wall of 0.8 mm between them.
Scene bowelBeside()
{
    constexpr double kWall_mm = 0.8;
    Scene scene(
        [](Point3 p) { return !inColon(p) && std::hypot(p.y + 6 - kColon_mm - kWall_mm - kBowel_mm, p.z) > kBowel_mm; },
        kFull);
    labelColonAlone(scene);
    return scene;
}

TEST(Openings, AreNoLumenTowardsOtherBowelAndTold)
{
    const Scene scene = bowelBeside();
    const TissueResult found = scene.find();
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n)
        if (const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
            found.lumen.voxels[n] != kOutside && std::abs(p.z) < 3) {
            EXPECT_LT(p.y, 1.8) << "not beyond the wall, at " << p.z;
        }
    ASSERT_FALSE(found.untrusted.faint.empty());
    EXPECT_NEAR(found.untrusted.faint[0].middle_mm.y, 1.4, 1.5);
    EXPECT_NEAR(found.untrusted.faint[0].middle_mm.z, 0, 2);
}

TEST(Openings, LeaveOtherBowelAsItWasAcquired)
{
    const Scene scene = bowelBeside();
    const HuVolume cleansed = scene.find().cleansed;
    const auto at = [&](const HuVolume& hu, double y_mm) { return hu.at(hu.grid.indexAt({0, y_mm, 0})); };
    for (const double y_mm : {4.0, 5.0, 7.0, 9.0})
        EXPECT_EQ(at(cleansed, y_mm), at(scene.hu, y_mm)) << y_mm;
    EXPECT_LT(at(cleansed, -6), -900) << "the colon's own is taken out";
}

/// A wedge of fluid between two folds that the labels were cut off from.
Scene wedgeBeside()
{
    Scene scene(
        [](Point3 p) { return !inColon(p) && !(std::abs(p.x) < 2.5 && std::abs(p.z) < 2.5 && p.y > 0 && p.y < 2.9); },
        kFull);
    labelColonAlone(scene);
    return scene;
}

TEST(Openings, OfAPocketThatAPersonCutOffAreNoLumenAndNotTold)
{
    const TissueResult found = wedgeBeside().find(20, {{0, 1, 0}});
    EXPECT_EQ(found.lumen.at(found.lumen.grid.indexAt({0, 2.45, 0})), kOutside);
    EXPECT_TRUE(found.untrusted.faint.empty());
}

TEST(Openings, ThatWouldJoinTwoPiecesAreNoLumenAndTold)
{
    const auto inPiece = [](Point3 p) { return std::hypot(std::abs(p.y) - 10, p.z) < 5; };
    Scene scene(
        [&](Point3 p) {
            const bool between = std::abs(p.x) < 2.5 && std::abs(p.z) < 2.5 && std::abs(p.y) < 6;
            return !inPiece(p) && !between;
        },
        kFull);
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n)
        if (!inPiece(scene.grid.pointAt(scene.grid.indexOf(n))))
            scene.inside.voxels[n] = kOutside;
    const TissueResult found = scene.find();
    const RunLabels parts = labelLumen(found.lumen, Neighbours::faces);
    const auto partAt = [&](Point3 p) { return parts.labelAt(found.lumen.grid.indexAt(p)); };
    EXPECT_GE(partAt({0, -10, 0}), 0);
    EXPECT_GE(partAt({0, 10, 0}), 0);
    EXPECT_NE(partAt({0, -10, 0}), partAt({0, 10, 0}));
    EXPECT_FALSE(found.untrusted.faint.empty());
}

TEST(Openings, OfAPocketWithItsOwnWallsAreLumen)
{
    const TissueResult found = wedgeBeside().find();
    const auto label = [&](double y_mm) { return found.lumen.at(found.lumen.grid.indexAt({0, y_mm, 0})); };
    EXPECT_EQ(label(2.45), kFluid);
    EXPECT_EQ(label(3.85), kOutside);
    EXPECT_TRUE(found.untrusted.faint.empty());
    EXPECT_LT(found.cleansed.at(found.cleansed.grid.indexAt({0, 1.75, 0})), -500);
}

}  // namespace
}  // namespace vicon::steps

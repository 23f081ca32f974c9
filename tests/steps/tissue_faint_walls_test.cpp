#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grid/run_labels.h"
#include "tissue/closed_walls.h"
#include "tissue/faint_walls.h"
#include "tissue/lumen_of_tissue.h"
#include "tissue_scene.h"

namespace vicon::steps {
namespace {

constexpr int kChannel = 12;  // voxels a side of a channel's cross-section
constexpr int kWall_j = 14;   // layers of the wall between the channels: this one and the next

/// Two channels side by side, with a wall of two voxels between them, open to one another at one end.
struct Loops {
    TissueVolume tissue;
    InsideVolume lumen;
    DownAxis down{lumen.grid, {0, 1, 0}};

    explicit Loops(int length_voxels, bool joined = true)
        : tissue(gridOf(length_voxels), 255), lumen(tissue.grid, kOutside)
    {
        for (int k = 2; k < 2 + kChannel; ++k)
            for (int j = 2; j < kWall_j + 2 + kChannel; ++j)
                for (int i = 2; i < 2 + length_voxels; ++i)
                    if ((j != kWall_j && j != kWall_j + 1) || (joined && i < 2 + kChannel))
                        open({i, j, k}, 0);
    }

    void open(Index3 v, double fraction)
    {
        lumen.at(v) = kGas;
        tissue.at(v) = std::uint8_t(std::lround(fraction * 255));
    }

    /// Makes a hole of 3 x 3 voxels near the far end.
    void tear(double fraction)
    {
        for (int k = 6; k < 9; ++k)
            for (int i = -6; i < -3; ++i)
                for (int j = kWall_j; j < kWall_j + 2; ++j)
                    open({tissue.grid.size[0] - 2 + i, j, k}, fraction);
    }

    /// Whether the wall is whole away from where the channels meet.
    bool isWhole() const
    {
        for (int k = 0; k < lumen.grid.size[2]; ++k)
            for (int i = 2 + kChannel; i < lumen.grid.size[0]; ++i)
                if (lumen.at({i, kWall_j, k}) != kOutside && lumen.at({i, kWall_j + 1, k}) != kOutside)
                    return false;
        return true;
    }

private:
    static Grid gridOf(int length_voxels)
    {
        return {.size = {length_voxels + 4, 2 * kChannel + 6, kChannel + 4},
                .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}};
    }
};

TEST(FaintWalls, AreClosedBetweenLoopsAndToldWithTheirPlace)
{
    for (const double fraction : {0.3, 0.4, 0.49}) {
        Loops loops(100);
        loops.tear(fraction);
        const Loops before = loops;
        const auto walls = closeFaintWalls(loops.lumen, {}, loops.down, loops.tissue, loops.lumen);
        ASSERT_EQ(walls.size(), 1U) << fraction;
        EXPECT_TRUE(loops.isWhole());
        EXPECT_NEAR(walls[0].wall.area_mm2, 9 * kVoxel_mm * kVoxel_mm, 0.6 * 9 * kVoxel_mm * kVoxel_mm);
        const Point3 middle = loops.tissue.grid.pointAt(ContinuousIndex3{97, kWall_j + 0.5, 7});
        EXPECT_LT(distance(walls[0].wall.middle_mm, middle), 1.5);
        for (std::size_t n = 0; n < loops.lumen.voxels.size(); ++n) {
            EXPECT_GE(loops.tissue.voxels[n], before.tissue.voxels[n]);
            if (loops.lumen.voxels[n] != before.lumen.voxels[n]) {
                EXPECT_GT(loops.tissue.voxels[n], 128) << "closed, so it is wall";
            }
        }
    }
}

TEST(FaintWalls, AreNoneWhereTheWallIsWhole)
{
    Loops loops(100);
    const Loops before = loops;
    EXPECT_TRUE(closeFaintWalls(loops.lumen, {}, loops.down, loops.tissue, loops.lumen).empty());
    EXPECT_EQ(loops.lumen.voxels, before.lumen.voxels);
    EXPECT_EQ(loops.tissue.voxels, before.tissue.voxels);
}

TEST(FaintWalls, AreNoneInAnOpenPassage)
{
    Loops loops(100);
    loops.tear(0.1);
    EXPECT_TRUE(closeFaintWalls(loops.lumen, {}, loops.down, loops.tissue, loops.lumen).empty());
    EXPECT_FALSE(loops.isWhole());
}

TEST(FaintWalls, AreClosedInFoldsAwayFromTheirEdge)
{
    for (const int from_edge : {2, 10}) {
        Loops fold(2 * kChannel + 6);  // the wall between the channels is a fold, its edge where they meet
        for (int k = 6; k < 9; ++k)
            for (int i = 0; i < 3; ++i)
                for (int j = kWall_j; j < kWall_j + 2; ++j)
                    fold.open({2 + kChannel + from_edge + i, j, k}, 0.4);
        EXPECT_EQ(closeFaintWalls(fold.lumen, {}, fold.down, fold.tissue, fold.lumen).size(), from_edge == 10 ? 1U : 0U)
            << from_edge;
        EXPECT_EQ(fold.isWhole(), from_edge == 10);
    }
}

TEST(FaintWalls, AreNoneInANarrowPassage)
{
    Loops loops(100);
    for (int k = 2; k < 2 + kChannel; ++k)  // a wall of 14 voxels
        for (int i = 2 + kChannel; i < 102; ++i)
            for (int j = kWall_j - 6; j < kWall_j + 8; ++j) {
                loops.lumen.at({i, j, k}) = kOutside;
                loops.tissue.at({i, j, k}) = 255;
            }
    for (int k = 6; k < 9; ++k)
        for (int i = 93; i < 96; ++i)
            for (int j = kWall_j - 6; j < kWall_j + 8; ++j)
                loops.open({i, j, k}, 0.4);
    EXPECT_TRUE(closeFaintWalls(loops.lumen, {}, loops.down, loops.tissue, loops.lumen).empty());
    EXPECT_FALSE(loops.isWhole());
}

TEST(FaintWalls, AreNoneBesideStool)
{
    Loops loops(100);
    loops.tear(0.4);
    const std::vector<std::size_t> dense{loops.lumen.grid.offset({95, kWall_j - 1, 7})};
    EXPECT_TRUE(
        closeFaintWalls(loops.lumen, {.lumps = 1, .dense = dense}, loops.down, loops.tissue, loops.lumen).empty());
}

/// Fluid on one side of the wall.
void pour(Loops& loops, bool below)
{
    for (std::size_t n = 0; n < loops.lumen.voxels.size(); ++n)
        if (const Index3 v = loops.lumen.grid.indexOf(n); loops.lumen.voxels[n] && (v.j > kWall_j) == below)
            loops.lumen.voxels[n] = kFluid;
}

TEST(FaintWalls, AreClosedInAFoldAtALevelToo)
{
    for (const bool fluid_below : {true, false}) {
        Loops loops(100);
        loops.tear(0.4);
        pour(loops, fluid_below);
        EXPECT_EQ(closeFaintWalls(loops.lumen, {}, loops.down, loops.tissue, loops.lumen).size(), 1U) << fluid_below;
    }
}

TEST(FaintWalls, AreNoLevelsOfFluid)
{
    // A chimney of 3 x 3 voxels stands on the hole, and nothing else above it.
    for (const bool fluid_below : {true, false}) {
        Loops loops(100);
        loops.tear(0.4);
        const int last = loops.lumen.grid.size[0] - 2;
        for (std::size_t n = 0; n < loops.lumen.voxels.size(); ++n) {
            const Index3 v = loops.lumen.grid.indexOf(n);
            const bool in_chimney = v.k >= 6 && v.k < 9 && v.i >= last - 6 && v.i < last - 3;
            if (v.j > 5 && v.j < kWall_j && v.i > 2 + kChannel && !in_chimney) {
                loops.lumen.voxels[n] = kOutside;
                loops.tissue.voxels[n] = 255;
            }
        }
        pour(loops, fluid_below);
        EXPECT_EQ(closeFaintWalls(loops.lumen, {}, loops.down, loops.tissue, loops.lumen).size(), fluid_below ? 0U : 1U)
            << "a pool in the loop above is none";
    }
}

TEST(FaintWalls, NeverCutTheOnlyWay)
{
    Loops loops(100, false);
    loops.tear(0.4);
    EXPECT_TRUE(closeFaintWalls(loops.lumen, {}, loops.down, loops.tissue, loops.lumen).empty());
    EXPECT_FALSE(loops.isWhole());
}

TEST(FaintWalls, ThatCutAPieceOfTheLabelsAreOpenedAgain)
{
    for (const bool joined : {false, true}) {
        Loops loops(100, joined);
        loops.tear(0.4);
        // The labels go through the tear, but for one column of it.
        InsideVolume labels = loops.lumen;
        const int last = loops.tissue.grid.size[0] - 2;
        labels.at({last - 6, kWall_j, 6}) = labels.at({last - 6, kWall_j + 1, 6}) = kOutside;
        const Loops before = loops;
        auto closed = closeFaintWalls(labels, {}, loops.down, loops.tissue, loops.lumen);
        ASSERT_EQ(closed.size(), 1U);
        EXPECT_TRUE(loops.isWhole());
        reopenCuts(labelLumen(labels, Neighbours::faces), closed, loops.tissue, loops.lumen);
        EXPECT_EQ(closed.size(), joined ? 1U : 0U);
        EXPECT_EQ(loops.isWhole(), joined) << "the only way is left open";
        EXPECT_EQ(loops.lumen.voxels == before.lumen.voxels, !joined);
        EXPECT_EQ(loops.tissue.voxels == before.tissue.voxels, !joined);
    }
}

TEST(LumenOfTissue, IsNotCutInOnePieceWhereAnotherOneVanishes)
{
    const Grid grid{.size = {60, 16, 16}, .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}};
    InsideVolume labels(grid, kOutside);
    TissueVolume tissue(grid, 255);
    for (int k = 2; k < 14; ++k)
        for (int j = 2; j < 14; ++j)
            for (int i = 2; i < 50; ++i) {
                if (i >= 40 && i < 44)
                    continue;
                labels.at({i, j, k}) = kGas;
                tissue.at({i, j, k}) = i < 40 && i != 20 ? 0 : 255;  // a sheet across the one, all of the other
            }
    const InsideVolume lumen = lumenOf(tissue, labels, labelLumen(labels, Neighbours::faces), {});
    const RunLabels parts = labelLumen(lumen, Neighbours::faces);
    ASSERT_GE(parts.labelAt({10, 8, 8}), 0);
    EXPECT_EQ(parts.labelAt({10, 8, 8}), parts.labelAt({30, 8, 8}));
}

/// Two loops of gas, 12 mm wide, with a wall of so many millimetres between them that grows thin in one place; joined
/// at one end.
Scene blurredLoops(double thin_mm)
{
    const auto isTissue = [thin_mm](Point3 p) {
        if (std::abs(p.x) > 12 || std::abs(p.z) > 24 || p.y > -1 || p.y < -13)
            return true;
        const double half_mm = std::hypot(p.y + 7, p.z - 19) < 2 ? thin_mm / 2 : 1.5;
        return std::abs(p.x) < half_mm && p.z > -16;
    };
    return Scene(isTissue, 100.0, 0, 72);
}

TEST(FaintWalls, OfBlurredScansAreWholeFromHalfAMillimetreOn)
{
    for (const double thin_mm : {0.5, 0.6, 0.8}) {
        Scene scene = blurredLoops(thin_mm);
        for (std::size_t n = 0; n < scene.inside.voxels.size(); ++n)  // as a mask has it that takes what is dim for gas
            if (scene.hu.voxels[n] < -300)
                scene.inside.voxels[n] = kGas;
        const TissueResult found = scene.find(5);
        for (int k = 40; k < 66; ++k)
            for (int j = 0; j < 72; ++j) {
                bool wall = false;
                for (int i = 30; i < 42; ++i)
                    wall = wall || found.lumen.at({i, j, k}) == kOutside;
                ASSERT_TRUE(wall) << thin_mm << " mm at " << j << ", " << k;
            }
    }
}

}  // namespace
}  // namespace vicon::steps

#include "topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "euler.h"

namespace vicon::phantom {
namespace {

InsideVolume empty(int n)
{
    Grid grid;
    grid.size = {n, n, n};
    return InsideVolume(grid);
}

template <class Inside>
InsideVolume filled(int n, Inside inside)
{
    InsideVolume volume = empty(n);
    for (std::size_t v = 0; v < volume.voxels.size(); ++v) {
        const Index3 at = volume.grid.indexOf(v);
        volume.voxels[v] = inside(at.i - n / 2, at.j - n / 2, at.k - n / 2) ? kGas : kOutside;
    }
    return volume;
}

int euler26(const InsideVolume& v)
{
    return eulerNumber26(v, {0, 0, 0}, v.grid.size);
}
int euler6(const InsideVolume& v)
{
    return eulerNumber6(v, {0, 0, 0}, v.grid.size);
}

TEST(EulerNumber, IsThatOfTheShape)
{
    const struct {
        const char* name;
        InsideVolume volume;
        int euler;
    } cases[] = {
        {"nothing", empty(5), 0},
        {"ball", filled(21, [](int x, int y, int z) { return x * x + y * y + z * z < 64; }), 1},
        {"ball up to the rim", filled(9, [](int, int, int) { return true; }), 1},
        {"hollow ball",
         filled(21,
                [](int x, int y, int z) {
                    const int q = x * x + y * y + z * z;
                    return q < 81 && q > 16;
                }),
         2},
        {"ring", filled(25, [](int x, int y, int z) { return std::pow(std::hypot(x, y) - 8, 2) + z * z < 9; }), 0},
        {"two balls", filled(25, [](int x, int y, int z) { return std::pow(std::abs(x) - 7, 2) + y * y + z * z < 16; }),
         2},
    };
    for (const auto& c : cases) {
        EXPECT_EQ(euler26(c.volume), c.euler) << c.name;
        EXPECT_EQ(euler6(c.volume), c.euler) << c.name;
        EXPECT_EQ(countedEulerNumber(c.volume), c.euler) << c.name;
    }
}

TEST(EulerNumber, ConnectsOverCornersOrOverFacesOnly)
{
    InsideVolume volume = empty(4);
    volume.at({1, 1, 1}) = volume.at({2, 2, 2}) = kGas;
    EXPECT_EQ(euler26(volume), 1);
    EXPECT_EQ(euler6(volume), 2);
}

TEST(EulerNumber, OfNoiseEqualsThatCountedCellByCell)
{
    unsigned state = 1;
    for (int n = 0; n < 20; ++n) {
        const InsideVolume volume =
            filled(12, [&](int, int, int) { return ((state = state * 1664525 + 1013904223) >> 30) == 0; });
        EXPECT_EQ(euler26(volume), countedEulerNumber(volume));
    }
}

TEST(PartAtCorners, PartsCubesThatTouchByAnEdgeOrACornerAlone)
{
    const struct {
        const char* name;
        std::array<int, 3> offset;
    } cases[] = {{"edge of one voxel", {5, 5, 4}}, {"corner", {5, 5, 5}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name);
        InsideVolume volume = filled(25, [&](int x, int y, int z) {
            const auto cube = [](int a, int b, int d) { return a >= 0 && a < 5 && b >= 0 && b < 5 && d >= 0 && d < 5; };
            return cube(x, y, z) || cube(x - c.offset[0], y - c.offset[1], z - c.offset[2]);
        });
        ASSERT_EQ(euler26(volume), 1);
        const InsideVolume before = volume;
        const std::vector<Index3> out = partAtCorners(volume, {0, 0, 0}, volume.grid.size, 2);
        EXPECT_FALSE(out.empty());
        EXPECT_EQ(euler26(volume), 2);
        EXPECT_EQ(euler6(volume), 2);
        EXPECT_EQ(countPieces(volume), 2);
        std::size_t changed = 0;
        for (std::size_t n = 0; n < volume.voxels.size(); ++n)
            changed += volume.voxels[n] != before.voxels[n];
        EXPECT_EQ(changed, out.size());
    }
}

TEST(PartAtCorners, LeavesASoundVolumeAlone)
{
    InsideVolume ball = filled(21, [](int x, int y, int z) { return x * x + y * y + z * z < 64; });
    const InsideVolume before = ball;
    EXPECT_TRUE(partAtCorners(ball, {0, 0, 0}, ball.grid.size, 1).empty());
    EXPECT_EQ(ball.voxels, before.voxels);
}

/// Two folds reach into the lumen from both sides. Taking more of the lumen out would join them.
TEST(FillAtCorners, PartsFoldsThatTouchByAnEdgeOfOneVoxelOrACornerAlone)
{
    for (const int z : {-2, -3}) {
        InsideVolume volume = filled(25, [&](int x, int y, int k) {
            const bool right = x >= 0 && y >= 0 && y < 3 && k >= 0 && k < 3;
            const bool left = x < 0 && y >= -3 && y < 0 && k >= z && k < z + 3;
            return std::max({std::abs(x), std::abs(y), std::abs(k)}) < 8 && !right && !left;
        });
        ASSERT_EQ(euler26(volume), 1);
        ASSERT_EQ(euler6(volume), 0) << "round the folds";
        partAtCorners(volume, {0, 0, 0}, volume.grid.size, 1);
        EXPECT_NE(euler6(volume), 1);
        EXPECT_FALSE(fillAtCorners(volume, {0, 0, 0}, volume.grid.size, 1).empty());
        EXPECT_EQ(euler26(volume), 1);
        EXPECT_EQ(euler6(volume), 1);
    }
}

TEST(CountPieces, CountsWhatHangsTogetherOverFaces)
{
    EXPECT_EQ(countPieces(empty(4)), 0);
    EXPECT_EQ(countPieces(filled(5, [](int, int, int) { return true; })), 1);
    EXPECT_EQ(countPieces(filled(6, [](int x, int y, int z) { return (x + y + z) % 2 == 0; })), 108);
}

}  // namespace
}  // namespace vicon::phantom

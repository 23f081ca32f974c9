#include "grid/lumen_front.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "grid/brick_grid.h"
#include "grid/meniscus.h"

namespace vicon::steps {
namespace {

TEST(BrickGrid, HasABrickWhereSomethingLiesAndNowhereElse)
{
    for (const Index3 v : {Index3{0, 0, 0}, {0, 0, 3}, {0, 0, 4}, {3, 4, 7}, {4, 3, 8}, {8, 6, 9}}) {
        InsideVolume mask(Grid{.size = {9, 7, 10}});
        mask.at(v) = kGas;
        const BrickGrid bricks(mask);
        EXPECT_EQ(bricks.placeCount(), 2 * BrickGrid::kVoxels) << v.i << " " << v.j << " " << v.k;
        EXPECT_EQ(mask.grid.offset(bricks.voxelAt(bricks.placeOf(v))), mask.grid.offset(v));
    }
}

TEST(LumenFront, AComponentIsAllThatHangsTogetherOverCornersAndTheSameEveryTime)
{
    InsideVolume mask(Grid{.size = {12, 12, 12}});
    std::vector<std::uint32_t> line;
    for (int n = 1; n < 9; ++n) {
        const Index3 v{n, n < 5 ? n : 9 - n, n};
        mask.at(v) = kGas;
        line.push_back(std::uint32_t(mask.grid.offset(v)));
    }
    mask.at({11, 11, 0}) = kGas;
    LumenFront front(mask);
    std::vector<std::uint32_t> all = line;
    all.push_back(std::uint32_t(mask.grid.offset({11, 11, 0})));
    EXPECT_THAT(front.unreached(), testing::UnorderedElementsAreArray(all));
    for (const std::uint32_t from : {line.front(), line[4], line.back(), line.front()})
        EXPECT_THAT(front.componentOf(from), testing::UnorderedElementsAreArray(line));
    front.seed(line[3], 0);
    EXPECT_THAT(front.componentOf(line.front()), testing::UnorderedElementsAre(line[0], line[1], line[2]))
        << "the rest lies behind what was reached";
}

/// Whether gas that touches fluid lies within the meniscus' reach, by looking at every voxel there.
bool nearByLooking(const InsideVolume& labels, Index3 v)
{
    constexpr int kReach = Meniscus::kReach_voxels;
    const auto touchesFluid = [&](Index3 n) {
        const auto is = [&](int i, int j, int k) { return labels.valueOr({i, j, k}, kOutside) == kFluid; };
        return labels.valueOr(n, kOutside) == kGas &&
               (is(n.i - 1, n.j, n.k) || is(n.i + 1, n.j, n.k) || is(n.i, n.j - 1, n.k) || is(n.i, n.j + 1, n.k) ||
                is(n.i, n.j, n.k - 1) || is(n.i, n.j, n.k + 1));
    };
    for (int k = -kReach; k <= kReach; ++k)
        for (int j = -kReach; j <= kReach; ++j)
            for (int i = -kReach; i <= kReach; ++i)
                if (touchesFluid({v.i + i, v.j + j, v.k + k}))
                    return true;
    return false;
}

bool besideOtherSide(const InsideVolume& labels, Index3 v)
{
    const bool inside = labels.at(v) != kOutside;
    bool beside = false;
    for (const Index3 n : {Index3{v.i - 1, v.j, v.k},
                           {v.i + 1, v.j, v.k},
                           {v.i, v.j - 1, v.k},
                           {v.i, v.j + 1, v.k},
                           {v.i, v.j, v.k - 1},
                           {v.i, v.j, v.k + 1}})
        beside = beside || (labels.grid.contains(n) && (labels.at(n) != kOutside) != inside);
    return beside;
}

TEST(Meniscus, IsWhereLookingAtAllVoxelsFindsIt)
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        InsideVolume labels(Grid{.size = {17, 9, 11}});
        std::mt19937 random(seed);
        for (std::uint8_t& label : labels.voxels) {
            const unsigned draw = random() % 100;
            label = draw < 3 ? kGas : draw < 6 ? kFluid : kOutside;
        }
        const Meniscus meniscus(labels);
        std::vector<std::size_t> wall;
        for (std::size_t n = 0; n < labels.voxels.size(); ++n) {
            const Index3 v = labels.grid.indexOf(n);
            ASSERT_EQ(meniscus.near(v), nearByLooking(labels, v)) << v.i << " " << v.j << " " << v.k;
            if (meniscus.near(v) && besideOtherSide(labels, v))
                wall.push_back(n);
        }
        EXPECT_EQ(meniscus.wallNear(labels), wall);
    }
}

}  // namespace
}  // namespace vicon::steps

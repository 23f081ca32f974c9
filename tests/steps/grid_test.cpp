#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "grid/cheapest_ways.h"
#include "grid/cube_opening.h"
#include "grid/mask.h"
#include "grid/neighbours.h"
#include "vicon/core/disjoint_sets.h"
#include "vicon/core/nearest_voxel.h"
#include "vicon/core/volume.h"

namespace vicon::steps {
namespace {

using testing::ElementsAre;

/// A grid that lies obliquely, with voxels of three different edges.
Grid obliqueGrid()
{
    const double c = std::cos(0.4), s = std::sin(0.4);
    return {.size = {9, 7, 5},
            .origin_mm = {-4, 3, 11},
            .spacing_mm = {0.7, 1.1, 2.3},
            .axis = {Vector3{c, s, 0}, Vector3{-s, c, 0}, Vector3{0, 0, 1}}};
}

InsideVolume randomMask(const Grid& grid, double share, unsigned seed)
{
    InsideVolume mask(grid);
    std::mt19937 random(seed);
    for (std::uint8_t& label : mask.voxels)
        label = random() < share * double(std::mt19937::max()) ? kGas : kOutside;
    return mask;
}

/// What lies in a cube of 2 x 2 x 2 voxels of the mask, by looking at each cube.
InsideVolume inCubes(const InsideVolume& mask)
{
    InsideVolume kept(mask.grid);
    const std::array<int, 3> size = mask.grid.size;
    for (int k = 0; k + 1 < size[2]; ++k)
        for (int j = 0; j + 1 < size[1]; ++j)
            for (int i = 0; i + 1 < size[0]; ++i) {
                std::vector<Index3> cube;
                for (int n = 0; n < 8; ++n)
                    cube.push_back({i + (n & 1), j + (n >> 1 & 1), k + (n >> 2)});
                if (std::all_of(cube.begin(), cube.end(), [&](Index3 v) { return mask.at(v) != kOutside; }))
                    for (const Index3 v : cube)
                        kept.at(v) = kGas;
            }
    return kept;
}

TEST(CubeOpening, KeepsWhatLiesInACubeOfTwoVoxels)
{
    for (const std::array<int, 3> size : {std::array{9, 7, 5}, std::array{1, 7, 5}, std::array{9, 1, 5},
                                          std::array{9, 7, 1}, std::array{2, 2, 2}, std::array{150, 90, 4}}) {
        Grid grid = obliqueGrid();
        grid.size = size;
        for (const double share : {0.5, 0.8, 0.95, 1.0}) {
            InsideVolume mask = randomMask(grid, share, unsigned(1000 * share));
            const InsideVolume wanted = inCubes(mask);
            openByCubes(mask);
            EXPECT_EQ(mask.voxels, wanted.voxels) << size[0] << " x " << size[1] << " x " << size[2] << ", " << share;
        }
    }
}

TEST(NearestVoxel, IsTheOneThatLookingAtAllFinds)
{
    const Grid grid = obliqueGrid();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-12, 22);
    for (unsigned n = 0; n < 300; ++n) {
        const InsideVolume mask = randomMask(grid, n % 2 ? 0.02 : 0.3, n);
        const Point3 p{anywhere(random), anywhere(random), anywhere(random)};
        const double within_mm = n % 3 ? kAnyDistance_mm : 4;
        double least_mm = within_mm;
        for (std::size_t v = 0; v < mask.voxels.size(); ++v)
            if (mask.voxels[v])
                least_mm = std::min(least_mm, distance(grid.pointAt(grid.indexOf(v)), p));
        const auto found = nearestVoxel(grid, p, within_mm, [&](Index3 v) { return mask.at(v) != kOutside; });
        ASSERT_EQ(found.has_value(), least_mm < within_mm) << n;
        if (found) {
            EXPECT_EQ(found->distance_mm, least_mm);
            EXPECT_EQ(distance(grid.pointAt(found->voxel), p), least_mm);
        }
    }
}

TEST(NearestVoxel, OfEquallyNearOnesIsTheLaterAndTheLimitCounts)
{
    const Grid grid{.size = {4, 4, 4}};
    const auto all = [](Index3) { return true; };
    EXPECT_EQ(nearestVoxel(grid, {1.5, 1.5, 1.5}, kAnyDistance_mm, all)->voxel, (Index3{2, 2, 2}));
    const auto low = [](Index3 v) { return v.k <= 1 && v.j <= 1; };
    EXPECT_EQ(nearestVoxel(grid, {1.5, 1.5, 1.5}, kAnyDistance_mm, low)->voxel, (Index3{2, 1, 1}));
    EXPECT_TRUE(nearestVoxel(grid, {-2, 0, 0}, 2, all));
    EXPECT_FALSE(nearestVoxel(grid, {-2.001, 0, 0}, 2, all));
}

TEST(DisjointSets, HaveTheirSmallestMemberAsRootWhateverTheOrder)
{
    DisjointSets sets(8);
    sets.join(7, 5);
    sets.join(3, 6);
    sets.join(5, 3);
    sets.join(5, 7);
    std::vector<std::uint32_t> roots;
    for (std::uint32_t n = 0; n < 8; ++n)
        roots.push_back(sets.rootOf(n));
    EXPECT_THAT(roots, ElementsAre(0, 1, 2, 3, 4, 3, 3, 3));
}

TEST(Neighbours, OverFacesAreThoseInTheGridInTheOrderOfTheFaces)
{
    const Grid grid{.size = {3, 3, 3}};
    const auto around = [&](Index3 v) {
        std::vector<std::size_t> found;
        forEachOverFaces(grid, grid.offset(v), [&](std::size_t n) { found.push_back(n); });
        return found;
    };
    EXPECT_THAT(around({1, 1, 1}), ElementsAre(12, 14, 10, 16, 4, 22));
    EXPECT_THAT(around({0, 0, 2}), ElementsAre(19, 21, 9));
}

TEST(Neighbours, AFloodOverFacesStaysInItsConnectedPart)
{
    const Grid grid{.size = {6, 5, 4}};
    const InsideVolume mask = randomMask(grid, 0.55, 7);
    DisjointSets sets(mask.voxels.size());
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        forEachOverFaces(grid, n, [&](std::size_t m) {
            if (mask.voxels[n] && mask.voxels[m])
                sets.join(std::uint32_t(n), std::uint32_t(m));
        });
    const auto start = std::size_t(std::find(mask.voxels.begin(), mask.voxels.end(), kGas) - mask.voxels.begin());
    std::set<std::size_t> reached{start}, expected;
    floodOverFaces(grid, {start}, [&](std::size_t n) { return mask.voxels[n] && reached.insert(n).second; });
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        if (mask.voxels[n] && sets.rootOf(std::uint32_t(n)) == sets.rootOf(std::uint32_t(start)))
            expected.insert(n);
    EXPECT_EQ(reached, expected);
    EXPECT_GT(expected.size(), 10U);
}

TEST(Mask, AVoxelBesideTheOtherSideIsToldAlsoAtTheGridsEnd)
{
    InsideVolume mask(Grid{.size = {5, 5, 5}}, kGas);
    EXPECT_FALSE(besideOther(mask, {2, 2, 2}));
    EXPECT_TRUE(besideOther(mask, {0, 2, 2}));
    mask.at({2, 2, 3}) = kOutside;
    EXPECT_TRUE(besideOther(mask, {2, 2, 2}));
    EXPECT_TRUE(besideOther(mask, {2, 2, 3}));
    EXPECT_FALSE(besideOther(mask, {2, 1, 2}));
}

template <class Queue>
class CostQueues : public testing::Test {
};
using Queues = testing::Types<CheapestFirst, CheapestFirstWide>;
TYPED_TEST_SUITE(CostQueues, Queues);

TYPED_TEST(CostQueues, GiveTheCheapestAndOfEqualOnesTheSmallerNumber)
{
    TypeParam queue;
    std::vector<std::pair<float, std::uint32_t>> in, out;
    std::mt19937 random(5);
    for (int n = 0; n < 500; ++n)
        in.emplace_back(float(random() % 40) / 4, random() % 100);
    for (const auto& [cost, number] : in)
        queue.push(cost, number);
    while (!queue.empty()) {
        const auto [cost, number] = queue.pop();
        out.emplace_back(float(cost), number);
    }
    std::sort(in.begin(), in.end());
    EXPECT_EQ(out, in);
}

/// A row of nine fields, of which the fifth is dear, and a way round it.
TYPED_TEST(CostQueues, LeadTheCheapestWay)
{
    const Grid grid{.size = {9, 3, 1}};
    const auto costOf = [&](std::size_t n) { return n == 4 ? 10.0F : 1.0F; };
    CheapestWays<TypeParam> ways(grid.voxelCount(), 0);
    ways.run(
        [](std::uint32_t, auto) { return false; },
        [&](std::uint32_t n, auto offer) { forEachOverFaces(grid, n, [&](std::size_t m) { offer(m, costOf(m)); }); });
    EXPECT_EQ(ways.costOf(8), 10);
    EXPECT_THAT(ways.wayTo(8), ElementsAre(0, 1, 2, 3, 12, 13, 14, 5, 6, 7, 8));
    EXPECT_THAT(ways.wayTo(0), ElementsAre(0));
}

}  // namespace
}  // namespace vicon::steps

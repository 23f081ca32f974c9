// Where fluid is not one fluid, in a pool of 40 x 40 x 40 mm.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "tissue/mottled.h"

namespace vicon::steps {
namespace {

constexpr double kFluid_hu = 600, kNoise_hu = 25, kHalf_mm = 20, kSpacing_mm = 0.8;

struct Pool {
    /// @param density of a place in the pool
    explicit Pool(const std::function<double(Point3)>& density, double noise_hu = kNoise_hu)
    {
        Grid grid;
        grid.size = {64, 64, 64};
        grid.spacing_mm = {kSpacing_mm, kSpacing_mm, kSpacing_mm};
        grid.origin_mm = {-25.2, -25.2, -25.2};
        hu = HuVolume(grid);
        inside = InsideVolume(grid);
        std::mt19937 random(3);
        std::normal_distribution<double> noise(0, noise_hu);
        for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            const bool fluid = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < kHalf_mm;
            inside.voxels[n] = fluid ? kFluid : kOutside;
            hu.voxels[n] = std::int16_t(std::lround((fluid ? density(p) : 40) + noise(random)));
        }
    }
    MottledTagging mottled() const { return findMottled({hu, inside, WallDensities()}, {}, kNoise_hu); }

    HuVolume hu;
    InsideVolume inside;
};

double even(Point3)
{
    return kFluid_hu;
}

/// Lumps of 5 mm, each of another density.
double lumpsBeyondMiddle(Point3 p)
{
    if (p.x < 0)
        return kFluid_hu;
    const auto lump = [](double mm) { return int(std::floor(mm / 5)); };
    return (lump(p.x) + lump(p.y) + lump(p.z)) % 2 != 0 ? 300 : 900;
}

TEST(MottledTagging, IsNoneInAnEvenPool)
{
    EXPECT_TRUE(Pool(even).mottled().blocks_mm.empty());
}

TEST(MottledTagging, IsNoneWhereSedimentThickensSlowly)
{
    EXPECT_TRUE(Pool([](Point3 p) { return kFluid_hu + 15 * p.z; }).mottled().blocks_mm.empty());
}

TEST(MottledTagging, IsWhereLumpsLieAndNowhereElse)
{
    const MottledTagging found = Pool(lumpsBeyondMiddle).mottled();
    for (const Point3& block : found.blocks_mm)
        EXPECT_GT(block.x, -found.block_mm / 2);
    const double lumps_ml = kHalf_mm * 2 * kHalf_mm * 2 * kHalf_mm / 1000;
    EXPECT_GT(found.volume_ml(), 0.6 * lumps_ml) << "but for the pool's edges";
    EXPECT_LT(found.volume_ml(), 1.3 * lumps_ml);
}

TEST(MottledTagging, IsNoSingleSpeck)
{
    const Pool speck([](Point3 p) { return std::hypot(p.x - 1, p.y - 1, p.z - 1) < 1.5 ? 1500 : kFluid_hu; });
    EXPECT_TRUE(speck.mottled().blocks_mm.empty());
}

TEST(MottledTagging, IsNotMadeOfTheNoiseOfDenseFluid)
{
    EXPECT_TRUE(Pool(even, 2 * kNoise_hu).mottled().blocks_mm.empty());
}

}  // namespace
}  // namespace vicon::steps

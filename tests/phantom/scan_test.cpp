#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "scans.h"
#include "vicon/core/error.h"

namespace vicon::phantom {
namespace {

/// Voxels whose neighbours within `reach` all carry the same label.
template <class Visit>
void eachDeepVoxel(const InsideVolume& inside, std::uint8_t label, int reach, Visit visit)
{
    const auto [nx, ny, nz] = inside.grid.size;
    for (int k = reach; k < nz - reach; ++k)
        for (int j = reach; j < ny - reach; ++j)
            for (int i = reach; i < nx - reach; ++i) {
                bool deep = true;
                for (int dk = -reach; deep && dk <= reach; ++dk)
                    for (int dj = -reach; deep && dj <= reach; ++dj)
                        for (int di = -reach; deep && di <= reach; ++di)
                            deep = inside.at({i + di, j + dj, k + dk}) == label;
                if (deep)
                    visit(Index3{i, j, k});
            }
}

TEST(PhantomScan, HoldsGasAtMinusThousandAndFluidAtItsPoolsDensity)
{
    const PhantomScan& scan = cleanScan();
    int gas = 0, fluid = 0;
    eachDeepVoxel(scan.truth.inside, kGas, 2, [&](Index3 v) {
        ++gas;
        EXPECT_NEAR(scan.hu.at(v), -1000, 3);
    });
    eachDeepVoxel(scan.truth.inside, kFluid, 1, [&](Index3 v) {
        ++fluid;
        const double hu = scan.hu.at(v);
        EXPECT_TRUE(std::any_of(scan.truth.pools.begin(), scan.truth.pools.end(),
                                [hu](const FluidPool& pool) { return std::abs(pool.density_hu - hu) < 25; }))
            << hu << " HU is no pool's density";
    });
    EXPECT_GT(gas, 1000);
    EXPECT_GT(fluid, 3);
    for (const FluidPool& pool : scan.truth.pools) {
        EXPECT_GE(pool.density_hu, 300);
        EXPECT_LE(pool.density_hu, 900);
    }
}

TEST(PhantomScan, HasTheWallHalfWayBetweenGasAndTissueWhereTheTruthEnds)
{
    // Labels and densities are two pictures of one surface: where they disagree, the density lies near the middle.
    const PhantomScan& scan = cleanScan();
    int counted = 0, wrong = 0;
    for (std::size_t v = 0; v < scan.hu.voxels.size(); ++v) {
        if (scan.truth.inside.voxels[v] != kGas)
            continue;
        ++counted;
        wrong += scan.hu.voxels[v] > -300;
    }
    EXPECT_LT(wrong, counted / 100);
}

TEST(PhantomScan, ShowsLungsAtTheHeadsEndAndBonesAndTheTable)
{
    const PhantomScan& scan = cleanScan();
    int lung_high = 0, lung_low = 0, bone = 0, table = 0;
    for (std::size_t v = 0; v < scan.hu.voxels.size(); ++v) {
        const Point3 p = scan.hu.grid.pointAt(scan.hu.grid.indexOf(v));
        const int hu = scan.hu.voxels[v];
        const bool lung = hu > -930 && hu < -780 && std::abs(p.x) < 130 && std::abs(p.y) < 80;
        lung_high += lung && p.z > 400;
        lung_low += lung && p.z < 300 && scan.truth.inside.voxels[v] == kOutside;
        bone += hu > 300 && scan.truth.inside.voxels[v] == kOutside;
        table += p.y > 124 && hu > -950;
    }
    EXPECT_GT(lung_high, 5000);
    EXPECT_LT(lung_low, lung_high / 10);
    EXPECT_GT(bone, 2000);
    EXPECT_GT(table, 3000);
}

TEST(PhantomScan, IsPaddedOutsideTheCircleOnly)
{
    const PhantomScan& scan = cleanScan();
    const auto [nx, ny, nz] = scan.hu.grid.size;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const double radius = std::hypot(i - (nx - 1) / 2.0, j - (ny - 1) / 2.0);
            EXPECT_EQ(scan.hu.at({i, j, nz / 2}) == kPaddingHu, radius > nx / 2.0);
        }
}

TEST(PhantomScan, HasTheNoiseThatTheTruthStates)
{
    const PhantomScan noisy = scanOf(smallOptions());
    EXPECT_GE(noisy.truth.noise_hu, 15);
    EXPECT_LE(noisy.truth.noise_hu, 40);
    double squares = 0;
    int count = 0;
    for (std::size_t v = 0; v < noisy.hu.voxels.size(); ++v) {
        const Point3 p = noisy.hu.grid.pointAt(noisy.hu.grid.indexOf(v));
        const double clean = cleanScan().hu.voxels[v];
        if (std::hypot(p.x, p.y) > 40 || clean < -200)
            continue;
        squares += std::pow(noisy.hu.voxels[v] - clean, 2);
        ++count;
    }
    EXPECT_NEAR(std::sqrt(squares / count), noisy.truth.noise_hu, 0.08 * noisy.truth.noise_hu);
    PhantomOptions low = smallOptions();
    low.low_dose = true;
    EXPECT_GE(scanOf(low).truth.noise_hu, 50);
}

TEST(PhantomScan, FollowsFromTheSeedOnAnyNumberOfThreads)
{
    const auto made = [](std::size_t threads, std::uint64_t seed) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return scanOf(smallOptions(seed), "HFP");
    };
    const PhantomScan one = made(1, 2), again = made(1, 2), four = made(4, 2), other = made(4, 3);
    EXPECT_EQ(one.hu.voxels, again.hu.voxels);
    EXPECT_EQ(one.hu.voxels, four.hu.voxels);
    EXPECT_EQ(one.truth.inside.voxels, four.truth.inside.voxels);
    EXPECT_EQ(one.truth.volume_ml, four.truth.volume_ml);
    EXPECT_NE(one.hu.voxels, other.hu.voxels);
}

TEST(PhantomScan, RefusesWhatItCannotMake)
{
    const auto codeOf = [](const PhantomOptions& options, const std::string& position) {
        try {
            scanOf(options, position);
        } catch (const Error& error) {
            return nameOf(error.code());
        }
        return std::string_view("none");
    };
    PhantomOptions many_gaps = smallOptions(), no_columns = smallOptions();
    many_gaps.gaps = 40;
    no_columns.size[0] = 0;
    EXPECT_EQ(codeOf(many_gaps, "HFS"), nameOf(ErrorCode::wrong_use));
    EXPECT_EQ(codeOf(no_columns, "HFS"), nameOf(ErrorCode::wrong_use));
    EXPECT_EQ(codeOf(smallOptions(), "HFX"), nameOf(ErrorCode::wrong_use));
}

TEST(PhantomScan, StopsWhenCancelled)
{
    struct Cancelled : NoProgress {
        bool cancelled() const override { return true; }
    } progress;
    try {
        makeScan(smallOptions(), "HFS", progress);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace vicon::phantom

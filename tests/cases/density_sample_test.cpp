#include "vicon/cases/density_sample.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "density_scenes.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

using test::Blurred;
using test::FlatWall;
using test::Polyp;

/// Even tissue to the left of x = 0, gas or tagged fluid to the right, blurred with a sigma of 0.8 mm as by a soft
/// kernel; not square voxels.
struct Wall {
    static constexpr double kBlur_mm = 0.8;
    HuVolume volume;
    InsideVolume inside;

    explicit Wall(double tissue_hu, double lumen_hu = -1000)
    {
        Grid grid;
        grid.size = {61, 41, 31};
        grid.spacing_mm = {0.5, 0.75, 1};
        grid.origin_mm = {-14.75, -15, -15};
        volume = HuVolume(grid);
        inside = InsideVolume(grid, kOutside);
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            const double x = grid.pointAt(grid.indexOf(n)).x;
            const double lumen = 0.5 * (1 + std::erf(x / kBlur_mm / std::numbers::sqrt2));
            volume.voxels[n] = std::int16_t(std::lround(tissue_hu + lumen * (lumen_hu - tissue_hu)));
            inside.voxels[n] = x > 0 ? kGas : kOutside;
        }
    }
};

/// As a reader circles what stands at x = `raised_mm`, from the lumen.
DensitySample circled(const Blurred& scene, double radius_mm, double raised_mm)
{
    const Point3 top{raised_mm, 0, 0};
    return sampleDensity(scene.volume, scene.inside, top - Vector3{radius_mm / 2, 0, 0}, radius_mm,
                         CircledWall{top, {-1, 0, 0}, raised_mm});
}

TEST(VirtualBiopsy, OfABallInTissueHasItsVolumeAndDensity)
{
    const Wall wall(40);
    const DensitySample sample = sampleDensity(wall.volume, wall.inside, {-9, 0, 0}, 5);
    EXPECT_NEAR(double(sample.voxels) * 0.5 * 0.75, 4.0 / 3 * std::numbers::pi * 125, 15);
    EXPECT_DOUBLE_EQ(sample.mean_hu, 40);
    EXPECT_NEAR(sample.sd_hu, 0, 1e-6);
    EXPECT_EQ(sample.fat_fraction, 0);
    EXPECT_EQ(sample.from_hu, 25);
    EXPECT_EQ(sample.counts, std::vector<std::size_t>{sample.voxels});
}

TEST(VirtualBiopsy, AtTheWallIsNotMixedWithTheGasOrTaggedFluidBesideIt)
{
    for (const double lumen_hu : {-1000.0, 400.0, 1200.0})
        for (const double tissue_hu : {-100.0, 40.0, 90.0}) {
            const Wall wall(tissue_hu, lumen_hu);
            const DensitySample sample = sampleDensity(wall.volume, wall.inside, {0, 0, 0}, 6);
            EXPECT_NEAR(sample.mean_hu, tissue_hu, 2) << lumen_hu;
            EXPECT_LT(sample.sd_hu, 4) << lumen_hu;
            // Half a ball, less a plate of two millimetres.
            const double part = std::numbers::pi * 16 * (3 * 6 - 4) / 3;
            EXPECT_NEAR(double(sample.voxels) * 0.5 * 0.75, part, 0.2 * part);
            EXPECT_EQ(sample.margin_mm, 2);
        }
}

TEST(VirtualBiopsy, OfAPolypIsThePolypsDensityWhereverInItTheReaderPoints)
{
    struct Case {
        double diameter_mm, tissue_hu, spacing_mm, blur_mm, within_hu;
    };
    // Half of each ball lies in the wall and the fat behind it: seen from its middle some fat is mixed in.
    for (const Case& c : {Case{10, 40, 0.74, 0.8, 22}, Case{8, 40, 0.74, 0.65, 22}, Case{6, 40, 0.74, 0.65, 30},
                          Case{10, -100, 0.74, 0.8, 22}, Case{8, -100, 0.9, 0.8, 22}, Case{10, 300, 0.74, 0.8, 60}}) {
        const Polyp polyp(c.diameter_mm, c.tissue_hu, c.spacing_mm, c.blur_mm);
        const double radius = c.diameter_mm / 2, half = radius / 2;
        for (const Point3 at : {Point3{half, 0, 0}, Point3{0.7 * half, 0.7 * half, 0}, Point3{0, 0, 0}}) {
            const DensitySample sample = sampleDensity(polyp.volume, polyp.inside, at, radius);
            ASSERT_GE(sample.voxels, DensitySample::kLeastVoxels) << c.diameter_mm << " mm at " << at.x;
            EXPECT_NEAR(sample.mean_hu, c.tissue_hu, c.within_hu) << c.diameter_mm << " mm at " << at.x << ", " << at.y;
        }
    }
}

TEST(VirtualBiopsy, OfABareWallIsTheWallAndNeverTheFatBehindIt)
{
    // Walls of 1 to 6 mm, in voxels and kernels as scanners have them.
    for (const double wall_mm : {1.0, 1.6, 2.0, 3.0, 4.0, 6.0})
        for (const auto& [spacing_mm, blur_mm] : {std::pair(0.6, 0.5), std::pair(0.74, 0.65), std::pair(0.9, 0.8)})
            for (const double radius_mm : {3.0, 5.0, 8.0}) {
                SCOPED_TRACE(testing::Message() << wall_mm << " mm, voxels of " << spacing_mm << ", " << radius_mm);
                const FlatWall wall(wall_mm, spacing_mm, blur_mm);
                const DensitySample sample = circled(wall, radius_mm, 0);
                if (sample.voxels == 0)
                    continue;
                EXPECT_GE(wall_mm, 2) << "too thin for a sample";
                EXPECT_NEAR(sample.mean_hu, 40, 15);
                EXPECT_LT(sample.fat_fraction, 0.05);
            }
    EXPECT_EQ(circled(FlatWall(1.6, 0.74, 0.65), 5, 0).voxels, 0U) << "refused";
    EXPECT_GT(circled(FlatWall(6, 0.74, 0.65), 5, 0).voxels, 0U) << "thick enough";
}

TEST(VirtualBiopsy, OfWhatStandsOnTheWallIsItsOwnDensityEvenThatOfFat)
{
    for (const double diameter_mm : {8.0, 10.0, 14.0})
        for (const double tissue_hu : {40.0, -100.0}) {
            const Polyp polyp(diameter_mm, tissue_hu, 0.74, 0.65);
            const DensitySample sample = circled(polyp, diameter_mm / 2, diameter_mm / 2);
            ASSERT_GE(sample.voxels, DensitySample::kLeastVoxels) << diameter_mm;
            EXPECT_NEAR(sample.mean_hu, tissue_hu, 12) << diameter_mm;
        }
}

TEST(VirtualBiopsy, OfALargePolypIsItsDensityFromItsTipAsWell)
{
    const Polyp polyp(10, 40, 0.74, 0.8);
    const DensitySample sample = sampleDensity(polyp.volume, polyp.inside, {5, 0, 0}, 5);
    EXPECT_NEAR(sample.mean_hu, 40, 12);
}

TEST(VirtualBiopsy, OfWhatIsTooThinForTheVoxelsSaysNothingRatherThanSomethingWrong)
{
    const Polyp polyp(6, 40, 2.4, 0.8);
    EXPECT_EQ(sampleDensity(polyp.volume, polyp.inside, {0, 0, 0}, 3).voxels, 0U);
}

TEST(VirtualBiopsy, SaysHowMuchOfItIsFat)
{
    const Polyp polyp(6, 40, 0.74, 0.65);
    const DensitySample fitting = sampleDensity(polyp.volume, polyp.inside, {3, 0, 0}, 3);
    const DensitySample large = sampleDensity(polyp.volume, polyp.inside, {0, 0, 0}, 9);
    EXPECT_LT(fitting.fat_fraction, 0.2);
    EXPECT_GT(large.fat_fraction, 0.5);
}

TEST(VirtualBiopsy, TakesEveryVoxelOfItsBallAndFatFromItsBorderOn)
{
    Wall wall(0);
    for (const auto& [hu, fat] :
         {std::pair(-201, 0.0), std::pair(-200, 1.0), std::pair(-30, 1.0), std::pair(-29, 0.0)}) {
        std::fill(wall.volume.voxels.begin(), wall.volume.voxels.end(), std::int16_t(hu));
        EXPECT_EQ(sampleDensity(wall.volume, wall.inside, {-8, 0, 0}, 4).fat_fraction, fat) << hu;
    }
    for (const double radius_mm : {3.76, 4.6, 5.0}) {
        const Point3 centre{-9, 0, 0};
        std::size_t voxels = 0;
        for (std::size_t n = 0; n < wall.volume.voxels.size(); ++n)
            voxels += distance(wall.volume.grid.pointAt(wall.volume.grid.indexOf(n)), centre) < radius_mm ? 1 : 0;
        EXPECT_EQ(sampleDensity(wall.volume, wall.inside, centre, radius_mm).voxels, voxels) << radius_mm;
    }
}

TEST(VirtualBiopsy, IsTheSameWithTheInsideVoxelsOfAPartOfTheScan)
{
    const Wall wall(40);
    Grid part = wall.inside.grid;
    part.size = {20, 30, 25};
    part.origin_mm = part.pointAt(Index3{25, 5, 3});
    InsideVolume inside(part, kOutside);
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        inside.voxels[n] = wall.inside.at(wall.inside.grid.indexAt(part.pointAt(part.indexOf(n))));
    const DensitySample whole = sampleDensity(wall.volume, wall.inside, {-1, 0, 0}, 4);
    const DensitySample cropped = sampleDensity(wall.volume, inside, {-1, 0, 0}, 4);
    EXPECT_EQ(cropped.voxels, whole.voxels);
    EXPECT_EQ(cropped.counts, whole.counts);
    EXPECT_LT(whole.voxels, sampleDensity(wall.volume, wall.inside, {-8, 0, 0}, 4).voxels) << "the lumen counts";
}

TEST(VirtualBiopsy, HistogramHoldsEveryVoxelWithinItsBin)
{
    Wall wall(0);
    for (std::size_t n = 0; n < wall.volume.voxels.size(); ++n)
        if (wall.inside.voxels[n] == kOutside)
            wall.volume.voxels[n] = n % 2 == 0 ? -30 : 70;
    const DensitySample sample = sampleDensity(wall.volume, wall.inside, {-8, 0, 0}, 5);
    ASSERT_EQ(sample.from_hu, -50);
    ASSERT_EQ(sample.counts.size(), 5U);  // -50, -25, 0, 25, 50
    EXPECT_EQ(std::accumulate(sample.counts.begin(), sample.counts.end(), std::size_t{0}), sample.voxels);
    EXPECT_EQ(sample.counts[1] + sample.counts[2] + sample.counts[3], 0U);
    const double high = double(sample.counts[4]) / double(sample.voxels);
    EXPECT_NEAR(sample.mean_hu, -30 + 100 * high, 1e-9);
    EXPECT_NEAR(sample.sd_hu, 100 * std::sqrt(high * (1 - high)), 1e-9);
    EXPECT_NEAR(sample.fat_fraction, 1 - high, 1e-9);
}

TEST(VirtualBiopsy, IsReadBackAsItWasKeptAndNothingElseIsTakenForOne)
{
    const Wall wall(40);
    const DensitySample sample = sampleDensity(wall.volume, wall.inside, {0, 1, 2}, 6);
    const DensitySample back = densitySampleFromJson(toJson(sample));
    EXPECT_EQ(toJson(back), toJson(sample));
    EXPECT_EQ(back.counts, sample.counts);
    for (const nlohmann::json& foreign :
         {nlohmann::json(), nlohmann::json("41 HU"), nlohmann::json{{"mean_hu", 40}}, nlohmann::json::array({1})})
        EXPECT_THROW(densitySampleFromJson(foreign), nlohmann::json::exception) << foreign;
}

TEST(VirtualBiopsy, InGasOrOutsideTheScanHasNoTissueAndOddRadiiAreRefused)
{
    const Wall wall(40);
    EXPECT_EQ(sampleDensity(wall.volume, wall.inside, {8, 0, 0}, 4).voxels, 0U);
    EXPECT_EQ(sampleDensity(wall.volume, wall.inside, {500, 0, 0}, 4).voxels, 0U);
    EXPECT_THROW(sampleDensity(wall.volume, wall.inside, {0, 0, 0}, 0), Error);
    EXPECT_THROW(sampleDensity(wall.volume, wall.inside, {0, 0, 0}, 26), Error);
}

}  // namespace
}  // namespace vicon

#include <gtest/gtest.h>

#include <cmath>

#include "scans.h"

namespace vicon::phantom {
namespace {

PhantomScan with(int stool, bool film)
{
    PhantomOptions options = smallOptions(3);
    options.size = {192, 192, 162};
    options.noise_hu = 0;
    options.stool = stool;
    options.film = film;
    return scanOf(options);
}

std::uint8_t labelAt(const PhantomScan& scan, Point3 p)
{
    return scan.truth.inside.at(scan.truth.inside.grid.indexAt(p));
}

double emptied_ml(const PhantomScan& without, const PhantomScan& scan)
{
    double voxels = 0;
    for (std::size_t n = 0; n < scan.truth.inside.voxels.size(); ++n)
        voxels += without.truth.inside.voxels[n] == kGas && scan.truth.inside.voxels[n] == kFluid ? 1 : 0;
    return voxels * scan.truth.inside.grid.voxelVolume_mm3() / 1000;
}

TEST(Stool, LiesInTheLumenAndLeavesItAsItIs)
{
    const PhantomScan without = with(0, false), scan = with(12, false);
    EXPECT_TRUE(without.truth.stool.empty());
    ASSERT_GE(scan.truth.stool.size(), 8U);
    double balls_ml = 0;
    for (const StoolLump& lump : scan.truth.stool) {
        EXPECT_GE(lump.diameter_mm, 5);
        EXPECT_LE(lump.diameter_mm, 18);
        balls_ml += 3.14159 / 6 * std::pow(lump.diameter_mm, 3) / 1000;
        if (!lump.airy) {
            EXPECT_EQ(labelAt(scan, lump.position_mm), kFluid) << lump.station_mm;
        }
        for (const Polyp& polyp : scan.truth.polyps)
            EXPECT_GT(std::abs(polyp.station_mm - lump.station_mm), 15);
    }
    for (std::size_t n = 0; n < scan.truth.inside.voxels.size(); ++n)
        ASSERT_EQ(scan.truth.inside.voxels[n] != kOutside, without.truth.inside.voxels[n] != kOutside);
    const double stool_ml = emptied_ml(without, scan);
    EXPECT_GT(stool_ml, 0.2 * balls_ml) << "balls of seven tenths, knobs, bubbles, and what the wall cuts off";
    EXPECT_LT(stool_ml, 0.8 * balls_ml);
}

TEST(Stool, WithAirHasGasInIt)
{
    const PhantomScan scan = with(12, false);
    int airy = 0;
    for (const StoolLump& lump : scan.truth.stool) {
        int gas = 0, all = 0;
        for (double x = -4; x <= 4; ++x)
            for (double y = -4; y <= 4; ++y)
                for (double z = -4; z <= 4; ++z)
                    if (const Vector3 off{x, y, z}; length(off) < 0.25 * lump.diameter_mm) {
                        const std::uint8_t label = labelAt(scan, lump.position_mm + off);
                        gas += label == kGas ? 1 : 0;
                        all += label != kOutside ? 1 : 0;
                    }
        airy += lump.airy ? 1 : 0;
        EXPECT_EQ(gas > 0.05 * all, lump.airy) << gas << " of " << all << " at " << lump.station_mm;
    }
    EXPECT_GT(airy, 0);
    EXPECT_LT(airy, int(scan.truth.stool.size()));
}

TEST(Film, ClingsToEveryPolyp)
{
    const PhantomScan scan = with(0, true);
    ASSERT_EQ(scan.truth.films.size(), scan.truth.polyps.size());
    for (const TaggingFilm& film : scan.truth.films) {
        const Polyp& polyp = scan.truth.polyps[film.polyp];
        EXPECT_GE(film.thickness_mm, 0.5);
        EXPECT_LE(film.thickness_mm, 2);
        const double film_mm = polyp.diameter_mm / 2 + film.thickness_mm;
        int tagged = 0;
        for (double x = -film_mm; x <= film_mm; ++x)
            for (double y = -film_mm; y <= film_mm; ++y)
                for (double z = -film_mm; z <= film_mm; ++z)
                    tagged += labelAt(scan, polyp.position_mm + Vector3{x, y, z}) == kFluid ? 1 : 0;
        // Thinner ones lie between the middles of such voxels, of 2 mm.
        if (film.thickness_mm > 1) {
            EXPECT_GT(tagged, 0) << polyp.station_mm;
        }
    }
}

}  // namespace
}  // namespace vicon::phantom

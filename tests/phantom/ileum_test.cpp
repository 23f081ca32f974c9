#include <gtest/gtest.h>

#include "scans.h"

namespace vicon::phantom {
namespace {

PhantomScan with(bool ileum)
{
    PhantomOptions options = smallOptions(2);
    options.size = {192, 192, 162};
    options.noise_hu = 0;
    options.ileum = ileum;
    return scanOf(options, "HFP");
}

TEST(Ileum, HangsOnTheColonAndIsNoPartOfIt)
{
    const PhantomScan without = with(false), scan = with(true);
    const TerminalIleum& ileum = scan.truth.ileum;
    EXPECT_EQ(without.truth.ileum.length_mm, 0);
    EXPECT_GE(ileum.length_mm, 100);
    EXPECT_GE(ileum.radius_mm, 5);
    EXPECT_LE(ileum.radius_mm, 10);
    EXPECT_GE(ileum.neck_radius_mm, 1.5);
    EXPECT_LE(ileum.neck_radius_mm, 2.5);
    EXPECT_GT(scan.truth.length_mm - ileum.station_mm, 20);
    EXPECT_LT(scan.truth.length_mm - ileum.station_mm, 85);
    // Medial: nearer to the middle of the trunk than the colon's axis there; the ascending colon lies at -x.
    Skeleton curve;
    curve.pieces.push_back({false, scan.truth.curve});
    EXPECT_GT(ileum.valve_mm.x, curve.at(ileum.station_mm).position_mm.x + 5);
    EXPECT_EQ(scan.truth.inside.voxels, without.truth.inside.voxels);
    // What is new is gas, or the pool's fluid, outside the colon.
    double filled_ml = 0;
    for (std::size_t n = 0; n < scan.hu.voxels.size(); ++n) {
        const int now = scan.hu.voxels[n], before = without.hu.voxels[n];
        if (!scan.truth.inside.voxels[n] && std::abs(now - before) > 200 && (now < -600 || now > 200))
            filled_ml += scan.hu.grid.voxelVolume_mm3() / 1000;
    }
    const double tube_ml = 3.14159 * ileum.radius_mm * ileum.radius_mm * ileum.length_mm / 1000;
    EXPECT_GT(filled_ml, 0.4 * tube_ml);
    EXPECT_LT(filled_ml, 1.1 * tube_ml);
}

}  // namespace
}  // namespace vicon::phantom

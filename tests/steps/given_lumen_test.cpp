// A lumen that another program made, instead of the one that is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "grid/run_labels.h"
#include "segment_shapes.h"
#include "vicon/steps/given_fit.h"
#include "vicon/steps/segment.h"

namespace vicon::steps {
namespace {

using test::centredGrid;
using test::dice;
using test::drawMask;
using test::tubeDistance;
using test::TubeScan;

const Grid kGrid = centredGrid({110, 80, 120}, 1.5);

/// A tube like a colon in small, half full of fluid.
TubeScan smallColon()
{
    return {.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {-45, 0, 45}, {-45, 0, -40}},
            .level_mm = 4,
            .fluid_hu = 600};
}

InsideVolume maskOf(const TubeScan& scan, const Grid& grid, double wider_mm = 0)
{
    InsideVolume mask = drawMask(grid, [&](Point3 p) { return scan.signedDistance(p) < wider_mm; });
    std::replace(mask.voxels.begin(), mask.voxels.end(), std::uint8_t(kFluid), std::uint8_t(kGas));
    return mask;
}

Segmentation segment(const TubeScan& scan, const InsideVolume& given, const SegmentOptions& options = {})
{
    NoProgress quiet;
    return segmentGivenColon(scan.draw(kGrid), given, scan.gravity, options, quiet);
}

GivenFit fit(const TubeScan& scan, const InsideVolume& given)
{
    NoProgress quiet;
    return fitOf(scan.draw(kGrid), given, Point3{}, {}, quiet);
}

TEST(GivenLumen, OnTheScansLatticeIsTakenVoxelByVoxelAndToldAsGasAndFluid)
{
    const TubeScan scan = smallColon();
    const Segmentation found = segment(scan, maskOf(scan, kGrid));
    EXPECT_NE(found.verdict, Verdict::absent) << found.reason;
    EXPECT_GT(dice(found.inside, kGrid, scan), 0.999);
    EXPECT_GT(found.measures["fluid_ml"].get<double>(), 10);
    EXPECT_GT(found.measures["gas_ml"].get<double>(), 10);
    for (std::size_t n = 0; n < found.inside.voxels.size(); ++n) {
        const Point3 p = found.inside.grid.pointAt(found.inside.grid.indexOf(n));
        if (found.inside.voxels[n] != kOutside && std::abs(p.y - scan.level_mm) > 2.5) {
            ASSERT_EQ(int(found.inside.voxels[n]), p.y > scan.level_mm ? kFluid : kGas) << p.x << " " << p.y;
        }
    }
    ASSERT_EQ(found.plan.pieces.size(), 1U);
    EXPECT_LT(distance(found.plan.pieces[0].rectal_end_mm, scan.line.front()), 14);
    EXPECT_LT(distance(found.plan.pieces[0].caecal_end_mm, scan.line.back()), 16);
}

TEST(GivenLumen, OnALatticeThatIsShiftedTurnedCoarserAndLeftHandedIsTheSameToHalfAVoxel)
{
    const TubeScan scan = smallColon();
    const double lean = 0.2;
    for (const double spacing_mm : {0.9, 1.5, 2.5}) {
        Grid grid;
        grid.spacing_mm = {spacing_mm, spacing_mm, spacing_mm * 1.3};
        grid.axis = {Vector3{0, 0, -1}, {std::cos(lean), std::sin(lean), 0}, {-std::sin(lean), std::cos(lean), 0}};
        ASSERT_LT(dot(cross(grid.axis[0], grid.axis[1]), grid.axis[2]), 0) << "left-handed";
        grid.size = {int(200 / spacing_mm), int(200 / spacing_mm), int(160 / spacing_mm)};
        grid.origin_mm = Point3{0.4, 0.3, 99} + grid.axis[1] * -100 + grid.axis[2] * -100;
        const Segmentation found = segment(scan, maskOf(scan, grid));
        EXPECT_GT(dice(found.inside, kGrid, scan), spacing_mm > 2 ? 0.95 : 0.97) << spacing_mm;
    }
}

TEST(GivenLumen, LosesWhatIsAsDenseAsTissueButForTheBlurredEdge)
{
    const TubeScan scan = smallColon();
    InsideVolume given = maskOf(scan, kGrid, 1.5);
    const TubeScan lump{.line = {{0, -20, 0}, {0, -20, 20}}, .radius_mm = 9};
    double lump_ml = 0;
    for (std::size_t n = 0; n < given.voxels.size(); ++n)
        if (lump.signedDistance(kGrid.pointAt(kGrid.indexOf(n))) < 0) {
            given.voxels[n] = kGas;
            lump_ml += kGrid.voxelVolume_mm3() / 1000;
        }
    const Segmentation found = segment(scan, given);
    EXPECT_GE(found.measures["given_dense_ml"].get<double>(), 0.99 * lump_ml);
    EXPECT_EQ(found.plan.pieces.size(), 1U);
    for (std::size_t n = 0; n < found.inside.voxels.size(); ++n)
        if (found.inside.voxels[n] != kOutside) {
            ASSERT_LT(scan.signedDistance(found.inside.grid.pointAt(found.inside.grid.indexOf(n))), 1.5);
        }
}

TEST(GivenLumen, OfTwoPiecesKeepsBothAndJoinsThemByABridge)
{
    TubeScan scan = smallColon();
    scan.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 10}};
    scan.second_line = {{45, 0, 40}, {-45, 0, 45}, {-45, 0, -40}};
    const Segmentation found = segment(scan, maskOf(scan, kGrid));
    EXPECT_EQ(found.plan.pieces.size(), 2U) << found.reason;
    EXPECT_EQ(found.plan.bridges.size(), 1U);
    EXPECT_GT(dice(found.inside, kGrid, scan), 0.999);
}

TEST(GivenLumen, ThatIsTooLittleForAColonIsDoubtedAndStays)
{
    TubeScan scan = smallColon();
    scan.line = {{0, 15, -60}, {0, 15, 0}};
    const Segmentation found = segment(scan, maskOf(scan, kGrid));
    EXPECT_EQ(found.verdict, Verdict::unsure);
    EXPECT_NE(found.reason.find("too little for a colon"), std::string::npos) << found.reason;
    EXPECT_GT(dice(found.inside, kGrid, scan), 0.999);
}

TEST(GivenLumen, OfTissueAloneIsNoColon)
{
    const TubeScan scan = smallColon(), lump{.line = {{0, -20, 0}, {0, -20, 20}}, .radius_mm = 9};
    EXPECT_EQ(segment(scan, maskOf(lump, kGrid)).verdict, Verdict::absent);
}

TEST(GivenLumen, TakesCorrections)
{
    TubeScan scan = smallColon();
    scan.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 10}};
    scan.second_line = {{45, 0, 40}, {-45, 0, 45}, {-45, 0, -40}};
    const InsideVolume first =
        drawMask(kGrid, [&](Point3 p) { return tubeDistance(scan.line, scan.radius_mm, p) < 0; });
    SegmentOptions add;
    add.add = {{-45, -6, 0}};
    EXPECT_EQ(segment(scan, first).plan.pieces.size(), 1U);
    EXPECT_EQ(segment(scan, first, add).plan.pieces.size(), 2U);
    SegmentOptions drop;
    drop.drop = {{-45, -6, 0}};
    EXPECT_EQ(segment(scan, maskOf(scan, kGrid), drop).plan.pieces.size(), 1U);
}

/// Along a tube's line, where it is nearest.
double alongLine_mm(const std::vector<Point3>& line, Point3 p)
{
    double least = 1e300, at = 0, before = 0;
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
        const Vector3 ab = line[n + 1] - line[n];
        const double t = std::clamp(dot(p - line[n], ab) / dot(ab, ab), 0.0, 1.0);
        if (const double away = distance(p, line[n] + ab * t); away < least) {
            least = away;
            at = before + t * length(ab);
        }
        before += length(ab);
    }
    return at;
}

TEST(GivenLumen, OfManyPiecesLosesNoneAndOfTooManyTheSmallestAndSaysSo)
{
    constexpr double kGap_mm = 6;
    const TubeScan scan = smallColon();
    const double all_mm = alongLine_mm(scan.line, scan.line.back());
    for (const int parts : {14, 22}) {
        const auto isGap = [&](Point3 p) { return std::fmod(alongLine_mm(scan.line, p), all_mm / parts) < kGap_mm; };
        InsideVolume given = maskOf(scan, kGrid);
        for (std::size_t n = 0; n < given.voxels.size(); ++n)
            if (given.voxels[n] != kOutside && isGap(kGrid.pointAt(kGrid.indexOf(n))))
                given.voxels[n] = kOutside;
        const auto pieces = labelLumen(given, Neighbours::faces).components.size();  // at corners some hang together
        ASSERT_EQ(pieces > 15, parts == 22) << pieces;
        SegmentOptions all;
        all.smallest_piece_ml = 0.1;
        const Segmentation found = segment(scan, given, all);
        EXPECT_EQ(found.plan.pieces.size(), std::min<std::size_t>(pieces, 15));
        EXPECT_GT(found.plan.pieces.size(), 10U);
        const std::string said = "its " + std::to_string(pieces - 15) + " smallest pieces were left out";
        EXPECT_EQ(found.reason.find(said) != std::string::npos, pieces > 15) << found.reason;
    }
}

TEST(GivenLumen, IsHeldAgainstTheDensitiesWhichTellHowItIsMirrored)
{
    TubeScan scan = smallColon();
    scan.line = {{0, 15, -70}, {0, 15, -45}, {45, 10, -40}, {45, 10, 45}, {20, 10, 45}};
    const InsideVolume own = maskOf(scan, kGrid);
    EXPECT_GT(fit(scan, own).gasOrFluid(), 0.9);
    EXPECT_EQ(fit(scan, own).in_scan, 1);
    EXPECT_EQ(fit(scan, own).mirrored, "");
    InsideVolume mirrored = drawMask(kGrid, [&](Point3 p) { return scan.signedDistance({-p.x, p.y, p.z}) < 0; });
    EXPECT_LT(fit(scan, mirrored).gasOrFluid(), 0.5);
    EXPECT_EQ(fit(scan, mirrored).mirrored, "left and right swapped");
    EXPECT_GT(fit(scan, mirrored).mirrored_fit, 0.9);
    InsideVolume away = own;
    away.grid.origin_mm.z += 1000;
    EXPECT_EQ(fit(scan, away).in_scan, 0);
}

}  // namespace
}  // namespace vicon::steps

#include "vicon/steps/segment.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "segment_shapes.h"
#include "vicon/core/error.h"
#include "vicon/steps/cells.h"

namespace vicon::steps {
namespace {

using test::centredGrid;
using test::tubeDistance;
using test::TubeScan;

/// A tube like a colon in small: up on the left, across, down on the right.
TubeScan smallColon()
{
    return {.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {-45, 0, 45}, {-45, 0, -40}}};
}

const Grid kGrid = centredGrid({110, 80, 120}, 1.5);

Segmentation segment(const HuVolume& volume, Vector3 gravity, SegmentOptions options = {})
{
    NoProgress progress;
    return segmentColon(volume, gravity, options, progress);
}

TEST(Segment, PutsTheWallAtTheHalfWayDensity)
{
    const TubeScan scan = smallColon();
    const Segmentation result = segment(scan.draw(kGrid), scan.gravity);
    EXPECT_NE(result.verdict, Verdict::absent) << result.reason;
    EXPECT_GE(dice(result.inside, kGrid, scan), 0.985);
    ASSERT_EQ(result.plan.pieces.size(), 1U);
    EXPECT_LT(distance(result.plan.pieces[0].rectal_end_mm, scan.line.front()), 14);
    EXPECT_LT(distance(result.plan.pieces[0].caecal_end_mm, scan.line.back()), 16);
}

class FluidLevels : public testing::TestWithParam<Vector3> {};

TEST_P(FluidLevels, AreFoundInEveryPosition)
{
    TubeScan scan = smallColon();
    scan.gravity = GetParam();
    scan.fluid_hu = 600;
    scan.level_mm = 4;
    const Segmentation result = segment(scan.draw(kGrid), scan.gravity);
    EXPECT_NE(result.verdict, Verdict::absent) << result.reason;
    EXPECT_GE(dice(result.inside, kGrid, scan), 0.97);
    EXPECT_GT(result.measures["fluid_ml"].get<double>(), 10);
}

INSTANTIATE_TEST_SUITE_P(Positions, FluidLevels,
                         testing::Values(Vector3{0, 1, 0}, Vector3{0, -1, 0}, Vector3{1, 0, 0}, Vector3{-1, 0, 0}));

/// Distances from the wall to the points of the surface that lie within 2.5 mm of the fluid's level, in order.
std::vector<double> wallErrorsAtLevel(const HuVolume& volume, const InsideVolume& inside, const TubeScan& scan)
{
    NoProgress progress;
    SegmentVolume segments(inside.grid);
    std::transform(inside.voxels.begin(), inside.voxels.end(), segments.voxels.begin(),
                   [](std::uint8_t label) { return std::uint16_t(label != kOutside); });
    const CellSurface surface = extractCells(volume, inside, segments, {}, progress);
    std::vector<double> errors_mm;
    for (std::size_t n = 0; n < surface.pointCount(); ++n) {
        const Point3 p = surface.point(n);
        if (std::abs(dot(p - Point3{}, scan.gravity) - scan.level_mm) < 2.5)
            errors_mm.push_back(std::abs(scan.signedDistance(p)));
    }
    std::sort(errors_mm.begin(), errors_mm.end());
    return errors_mm;
}

TEST(Segment, NoiseMakesNoHolesInAPool)
{
    TubeScan scan = smallColon();
    scan.fluid_hu = 320;
    scan.level_mm = -2;
    HuVolume volume = scan.draw(kGrid);
    std::uint32_t state = 12345;
    for (std::int16_t& hu : volume.voxels) {
        double sum = 0;  // of twelve uniform numbers: about normal, 80 HU
        for (int n = 0; n < 12; ++n) {
            state = state * 1664525U + 1013904223U;
            sum += double(state >> 8) / double(1U << 24);
        }
        hu = std::int16_t(std::lround(hu + 80 * (sum - 6)));
    }
    const Segmentation result = segment(volume, scan.gravity);
    int missed = 0, all = 0;
    for (std::size_t n = 0; n < kGrid.voxelCount(); ++n) {
        const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
        // Two voxels inside; without the rectum, which is full of fluid.
        if (scan.signedDistance(p) > -3 || p.z < -40)
            continue;
        ++all;
        missed += result.inside.valueOr(result.inside.grid.indexAt(p), kOutside) == kOutside ? 1 : 0;
    }
    ASSERT_GT(all, 8000);
    EXPECT_EQ(missed, 0) << "of " << all;
}

class FluidLine : public testing::TestWithParam<double> {};

TEST_P(FluidLine, HasASmoothWallBesideIt)
{
    TubeScan scan = smallColon();
    scan.fluid_hu = GetParam();
    scan.level_mm = -1.7;
    const Grid grid = centredGrid({188, 113, 206}, 0.8);
    const HuVolume volume = scan.draw(grid);
    const InsideVolume inside = segment(volume, scan.gravity).inside;
    const std::vector<double> errors_mm = wallErrorsAtLevel(volume, inside, scan);
    ASSERT_GT(errors_mm.size(), 1000U);
    // One percent lies where the tube's ceiling dips into the fluid at 18 degrees: gas in a wedge thinner than the
    // blur.
    const double most_mm = errors_mm[errors_mm.size() * 95 / 100];
    RecordProperty("p95_mm", std::to_string(most_mm));
    RecordProperty("p99_mm", std::to_string(errors_mm[errors_mm.size() * 99 / 100]));
    EXPECT_LT(most_mm, 0.5);
    // No hole in the layer between gas and fluid, two sigma of the blur away from the wall.
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Point3 p = grid.pointAt(grid.indexOf(n));
        if (std::abs(dot(p - Point3{}, scan.gravity) - scan.level_mm) < 2.5 && scan.signedDistance(p) < -1.6) {
            ASSERT_NE(inside.valueOr(inside.grid.indexAt(p), kOutside), kOutside) << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Densities, FluidLine, testing::Values(300, 900));

TEST(Segment, FaintFluidDoesNotMoveTheWallOfABrightPoolItRunsInto)
{
    TubeScan scan = smallColon();
    scan.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {0, 25, 45}, {-45, 0, 45}, {-45, 0, -40}};
    scan.level_mm = 4;
    scan.fluid_hu = 350;
    HuVolume volume = scan.draw(kGrid);
    scan.fluid_hu = 800;
    const HuVolume bright = scan.draw(kGrid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        if (kGrid.pointAt(kGrid.indexOf(n)).x < 30)  // most of it
            volume.voxels[n] = bright.voxels[n];
    const Segmentation result = segment(volume, scan.gravity);
    int outside = 0, missed = 0, truth = 0;
    for (std::size_t n = 0; n < kGrid.voxelCount(); ++n) {
        const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
        if (p.x > 20 || p.y < scan.level_mm + 5)
            continue;
        const double wall_mm = scan.signedDistance(p);
        const bool found = result.inside.valueOr(result.inside.grid.indexAt(p), kOutside) != kOutside;
        truth += wall_mm < 0 ? 1 : 0;
        outside += found && wall_mm > 0.2 ? 1 : 0;
        missed += !found && wall_mm < -0.2 ? 1 : 0;
    }
    EXPECT_GT(truth, 1000);
    EXPECT_LE(outside, truth / 1000);
    EXPECT_LE(missed, truth / 1000);
}

TEST(Segment, AFoldAlongTheFluidsLevelStaysWall)
{
    TubeScan scan = smallColon();
    scan.fluid_hu = 700;
    scan.level_mm = 4;
    HuVolume volume = scan.draw(kGrid);
    // A sheet of tissue, 3 mm thick, over the outer half of one stretch: gas above it, fluid below it.
    const auto sheet = [&](Point3 p) {
        const double away = std::max({std::abs(p.y - scan.level_mm) - 1.5, 46 - p.x, std::abs(p.z) - 20});
        return 1 - test::blurred(away, 0.7);
    };
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        std::int16_t& hu = volume.voxels[n];
        hu = std::int16_t(std::lround(std::lerp(double(hu), 40, sheet(kGrid.pointAt(kGrid.indexOf(n))))));
    }
    const Segmentation result = segment(volume, scan.gravity);
    int opened = 0, all = 0;
    for (std::size_t n = 0; n < kGrid.voxelCount(); ++n) {
        const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
        if (sheet(p) < 0.9 || p.x < 48 || std::abs(p.z) > 18 || scan.signedDistance(p) > -2)
            continue;  // the outermost voxel of its edge is rounded
        ++all;
        opened += result.inside.valueOr(result.inside.grid.indexAt(p), kOutside) != kOutside ? 1 : 0;
    }
    ASSERT_GT(all, 80);
    EXPECT_EQ(opened, 0) << "of " << all;
}

TEST(Segment, OrdersPiecesOverAGap)
{
    TubeScan scan = smallColon();
    scan.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 45}, {20, 0, 45}};
    scan.second_line = {{-25, 0, 45}, {-45, 0, 45}, {-45, 0, -40}};
    const Segmentation result = segment(scan.draw(kGrid), scan.gravity);
    ASSERT_EQ(result.plan.pieces.size(), 2U) << result.reason;
    ASSERT_EQ(result.plan.bridges.size(), 1U);
    EXPECT_LT(result.plan.pieces[0].rectal_end_mm.z, -50);
    EXPECT_LT(distance(result.plan.pieces[1].caecal_end_mm, {-45, 0, -45}), 16);
    EXPECT_TRUE(result.plan.bridges[0].certain);
    EXPECT_LT(result.plan.bridges[0].length_mm, 60);
}

/// The scan with its colon in fat: soft tissue is left as a wall of 2 mm and as a cord of 6 mm of radius.
HuVolume drawnInFat(const TubeScan& scan, const std::vector<Point3>& cord)
{
    HuVolume volume = scan.draw(kGrid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
        const double outside_mm = std::min(scan.signedDistance(p) - 2, tubeDistance(cord, 6, p));
        if (volume.voxels[n] > -100 && outside_mm > 0)
            volume.voxels[n] = std::int16_t(40 - 140 * std::min(1.0, outside_mm));
    }
    return volume;
}

TEST(Segment, BridgeFollowsTheBendOfTheCollapsedBowelThroughFat)
{
    TubeScan scan = smallColon();
    scan.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 30}};
    scan.second_line = {{-5, 0, 30}, {-45, 0, 30}, {-45, 0, -40}};
    // The lumens end 12 mm beyond the lines; the collapsed bowel goes up and round between them.
    const std::vector<Point3> cord{{45, 0, 42}, {43, 0, 50}, {36, 0, 57}, {26, 0, 58},
                                   {17, 0, 52}, {11, 0, 40}, {7, 0, 30}};
    const HuVolume volume = drawnInFat(scan, cord);
    const Segmentation result = segment(volume, scan.gravity);
    ASSERT_EQ(result.plan.bridges.size(), 1U) << result.reason;
    const Bridge& bridge = result.plan.bridges[0];
    double length_mm = 0;
    for (std::size_t n = 1; n < cord.size(); ++n)
        length_mm += distance(cord[n - 1], cord[n]);
    EXPECT_NEAR(bridge.length_mm, length_mm, 5);
    double along_mm = 0;
    for (std::size_t n = 1; n < bridge.path_mm.size(); ++n)
        along_mm += distance(bridge.path_mm[n - 1], bridge.path_mm[n]);
    EXPECT_DOUBLE_EQ(bridge.length_mm, along_mm);
    EXPECT_GT(bridge.confidence, 0.5) << bridge.reason;  // soft tissue all the way
    for (const Point3 p : bridge.path_mm)
        EXPECT_LT(tubeDistance(cord, 0, p), 4) << p.x << ' ' << p.y << ' ' << p.z;
    for (const Point3 end : {bridge.from_mm, bridge.to_mm})
        EXPECT_NEAR(scan.signedDistance(end), 0, 3);
}

TEST(Segment, EntersAPieceWhereTheCollapsedBowelLeadsNotWhereOnlyFatIsNearer)
{
    TubeScan scan = smallColon();
    scan.radius_mm = 10;
    scan.line = {{0, 15, -70}, {0, 15, -45}, {45, 0, -40}, {45, 0, 50}, {18, 0, 50}};
    // One end lies 12 mm from the end of the first piece; the collapsed bowel leads to the other one.
    scan.second_line = {{-8, 15, 15}, {-8, 15, -5}, {-45, 0, -5}, {-45, 0, 50}, {-14, 0, 50}};
    const std::vector<Point3> cord{{18, 4, 50}, {12, 14, 44}, {3, 18, 34}, {-7, 15, 24}};
    const HuVolume volume = drawnInFat(scan, cord);
    const Segmentation result = segment(volume, scan.gravity);
    ASSERT_EQ(result.plan.pieces.size(), 2U) << result.reason;
    EXPECT_LT(distance(result.plan.bridges[0].to_mm, {-8, 15, 25}), 8);
    EXPECT_LT(distance(result.plan.pieces[1].caecal_end_mm, {-14, 0, 50}), 16);
}

TEST(Segment, LeavesAMarginOutside)
{
    const TubeScan scan = smallColon();
    const InsideVolume inside = segment(scan.draw(kGrid), scan.gravity).inside;
    const auto& size = inside.grid.size;
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        const Index3 v = inside.grid.indexOf(n);
        if (v.i == 0 || v.j == 0 || v.k == 0 || v.i == size[0] - 1 || v.j == size[1] - 1 || v.k == size[2] - 1) {
            ASSERT_EQ(inside.voxels[n], kOutside);
        }
    }
}

TEST(Segment, DoesNotDependOnTheNumberOfThreads)
{
    TubeScan scan = smallColon();
    scan.fluid_hu = 500;
    scan.level_mm = 4;
    const HuVolume volume = scan.draw(kGrid);
    const Segmentation many = segment(volume, scan.gravity);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const Segmentation one = segment(volume, scan.gravity);
    EXPECT_EQ(one.inside.grid, many.inside.grid);
    EXPECT_EQ(one.inside.voxels, many.inside.voxels);
    EXPECT_EQ(toJson(one.plan), toJson(many.plan));
}

struct NoColonCase {
    const char* name;
    std::array<int, 3> size;
    std::int16_t hu;
};

class NoColon : public testing::TestWithParam<NoColonCase> {};

TEST_P(NoColon, IsAVerdictAndNoCrash)
{
    const HuVolume volume(centredGrid(GetParam().size, 1), GetParam().hu);
    const Segmentation result = segment(volume, {0, 1, 0});
    EXPECT_EQ(result.verdict, Verdict::absent) << GetParam().name;
    EXPECT_FALSE(result.reason.empty());
    EXPECT_TRUE(result.inside.voxels.empty());
    EXPECT_TRUE(result.plan.pieces.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Scans, NoColon,
    testing::Values(NoColonCase{"air", {64, 64, 79}, -1000}, NoColonCase{"padding", {64, 64, 79}, kPaddingHu},
                    NoColonCase{"tissue", {64, 64, 79}, 40}, NoColonCase{"bone", {32, 32, 16}, 900},
                    NoColonCase{"one voxel", {1, 1, 1}, -1000}, NoColonCase{"one slice", {40, 40, 1}, 40}));

/// A chest: two lungs that leave the scan at its upper end.
HuVolume chest(double lung_hu)
{
    TubeScan scan;
    scan.line = {{-32, 0, -70}, {-32, 0, 120}};
    scan.second_line = {{32, 0, -70}, {32, 0, 120}};
    scan.radius_mm = 20;
    HuVolume volume = scan.draw(kGrid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        const Point3 p = kGrid.pointAt(kGrid.indexOf(n));
        if (scan.signedDistance(p) < 5)
            volume.voxels[n] =
                std::int16_t(std::lround(40 - (40 - lung_hu) * (1 - test::blurred(scan.signedDistance(p), 0.7))));
    }
    return volume;
}

TEST(Segment, LungsAloneAreNoColon)
{
    const Segmentation result = segment(chest(-850), {0, 1, 0});
    EXPECT_EQ(result.verdict, Verdict::absent) << result.reason;
    EXPECT_FALSE(result.reason.empty());
    EXPECT_TRUE(result.inside.voxels.empty());
    // It is their density that tells: the same shapes full of gas are taken for bowel.
    const Segmentation gas = segment(chest(-1000), {0, 1, 0});
    EXPECT_NE(gas.verdict, Verdict::absent) << gas.reason;
    EXPECT_GT(gas.measures["gas_ml"].get<double>(), 300);
}

TEST(Segment, BinaryMethodTakesWhatTheSeedPointLiesIn)
{
    const TubeScan scan = smallColon();
    SegmentOptions options;
    options.method = SegmentMethod::binary;
    options.iso_hu = -480;
    options.seed = {{45, 0, 0}};
    const Segmentation result = segment(scan.draw(kGrid), scan.gravity, options);
    EXPECT_GE(dice(result.inside, kGrid, scan), 0.985);
    options.seed = {{0, -20, 0}};
    EXPECT_EQ(segment(scan.draw(kGrid), scan.gravity, options).verdict, Verdict::absent);
}

TEST(LumenPlan, SurvivesJson)
{
    LumenPlan plan;
    plan.pieces.push_back({{1, 2, 3}, {4, 5, 6}, 7, 8, 9, 10});
    plan.pieces.push_back({{11, 12, 13}, {14, 15, 16}, 17, 18, 19, 20});
    plan.bridges.push_back({{4, 5, 6}, {11, 12, 13}, {{4, 5, 6}, {11, 12, 13}}, 12.1, 0.5, "why", true});
    EXPECT_EQ(toJson(lumenPlanFromJson(toJson(plan))), toJson(plan));
    EXPECT_THROW(lumenPlanFromJson({{"pieces", 1}}), Error);
}

}  // namespace
}  // namespace vicon::steps

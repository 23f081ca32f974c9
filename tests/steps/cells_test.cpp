#include "vicon/steps/cells.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "field_shapes.h"
#include "vicon/core/error.h"
#include "vicon/steps/densities_around.h"

namespace vicon::steps {
namespace {

NoProgress quiet;

constexpr double kGasHu = -1000, kTissueHu = 40, kFluidHu = 600;

/// The part of a blurred edge (Gaussian of `sigma_mm`) that lies beyond it.
double beyond(double signed_mm, double sigma_mm)
{
    return 0.5 * std::erfc(-signed_mm / (std::sqrt(2.0) * sigma_mm));
}

struct Scan {
    HuVolume hu;
    InsideVolume inside;
    SegmentVolume segments;
};

/// A blurred ball of gas or fluid around the origin in tissue, two segments below and above z = 0.
Scan ball(double radius_mm, std::uint8_t content, std::array<Vector3, 3> axis = Grid{}.axis)
{
    Grid grid{.size = {64, 64, 64}, .spacing_mm = {0.7, 0.7, 0.7}, .axis = axis};
    grid.origin_mm = Point3{} - (axis[0] * 22.3 + axis[1] * 22.1 + axis[2] * 21.9);
    Scan scan{HuVolume(grid), InsideVolume(grid), SegmentVolume(grid)};
    const double within = content == kGas ? kGasHu : kFluidHu, level = (within + kTissueHu) / 2;
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Point3 p = grid.pointAt(grid.indexOf(n));
        const double hu = within + (kTissueHu - within) * beyond(length(p - Point3{}) - radius_mm, 0.7);
        scan.hu.voxels[n] = std::int16_t(std::lround(hu));
        scan.inside.voxels[n] = (content == kGas ? hu < level : hu > level) ? content : std::uint8_t(kOutside);
        scan.segments.voxels[n] = scan.inside.voxels[n] ? (p.z < 0 ? 1 : 2) : 0;
    }
    return scan;
}

template <class T>
Volume<T> partOf(const Volume<T>& whole, Index3 lower, std::array<int, 3> size)
{
    Grid grid = whole.grid;
    grid.size = size;
    grid.origin_mm = whole.grid.pointAt(lower);
    Volume<T> part(grid);
    for (std::size_t n = 0; n < part.voxels.size(); ++n) {
        const Index3 v = grid.indexOf(n);
        part.voxels[n] = whole.at({lower.i + v.i, lower.j + v.j, lower.k + v.k});
    }
    return part;
}

CellSurface cellsOf(const Scan& scan)
{
    return extractCells(scan.hu, scan.inside, scan.segments, {}, quiet);
}

Vector3 normalAt(const CellSurface& s, std::size_t n)
{
    return {s.normals[3 * n], s.normals[3 * n + 1], s.normals[3 * n + 2]};
}

struct Measures {
    double area_mm2 = 0;
    double volume_mm3 = 0;  ///< enclosed; positive when front sides look inwards
};

Measures measure(const CellSurface& s)
{
    Measures m;
    for (std::size_t t = 0; t < s.triangleCount(); ++t) {
        const Point3 a = s.point(s.triangles[3 * t]), b = s.point(s.triangles[3 * t + 1]),
                     c = s.point(s.triangles[3 * t + 2]);
        const Vector3 across = cross(b - a, c - a);
        m.area_mm2 += length(across) / 2;
        m.volume_mm3 -= dot(a - Point3{}, across) / 6;
    }
    return m;
}

/// Every edge lies in exactly two triangles, once in each direction: the surface is closed and consistently wound.
void expectClosed(const CellSurface& s)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < s.triangleCount(); ++t)
        for (std::size_t n = 0; n < 3; ++n)
            ++edges[{s.triangles[3 * t + n], s.triangles[3 * t + (n + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
}

/// The blurred edge of a ball passes each density at a known place.
TEST(Cells, LieWhereTheDensityIsTheWalls)
{
    const double radius_mm = 18, sigma_mm = 0.7;
    for (const double off_mm : {-0.5, 0.0, 0.5}) {
        Scan scan = ball(radius_mm, kGas);
        const double wall_hu = kGasHu + (kTissueHu - kGasHu) * beyond(off_mm, sigma_mm);
        for (std::size_t n = 0; n < scan.inside.voxels.size(); ++n) {
            scan.inside.voxels[n] = scan.hu.voxels[n] < wall_hu ? kGas : kOutside;
            scan.segments.voxels[n] = scan.inside.voxels[n] ? 1 : 0;
        }
        const WallDensities densities{.wall_hu = wall_hu, .tissue_hu = kTissueHu};
        const auto surface = extractCells(scan.hu, scan.inside, scan.segments, densities, quiet);
        const double found_mm = std::cbrt(measure(surface).volume_mm3 * 3 / (4 * std::numbers::pi));
        EXPECT_NEAR(found_mm, radius_mm + off_mm, 0.05) << wall_hu;
    }
}

TEST(Cells, OfABlurredBallHaveItsAreaVolumeAndNormals)
{
    const double radius_mm = 18;
    for (const std::uint8_t content : {kGas, kFluid}) {
        const auto surface = cellsOf(ball(radius_mm, content));
        const Measures m = measure(surface);
        EXPECT_NEAR(m.area_mm2, 4 * M_PI * radius_mm * radius_mm, 0.002 * 4 * M_PI * radius_mm * radius_mm);
        EXPECT_NEAR(m.volume_mm3, 4.0 / 3 * M_PI * std::pow(radius_mm, 3),
                    0.003 * 4.0 / 3 * M_PI * std::pow(radius_mm, 3));
        for (std::size_t n = 0; n < surface.pointCount(); ++n) {
            ASSERT_NEAR(length(surface.point(n) - Point3{}), radius_mm, 0.05);
            ASSERT_GT(dot(normalAt(surface, n), normalized(Point3{} - surface.point(n))), std::cos(3 * M_PI / 180));
        }
        expectClosed(surface);
    }
}

TEST(Cells, LieRightInTurnedAndMirroredGrids)
{
    const Vector3 x = normalized({1, 0.2, -0.1}), y = normalized(cross({0.1, 0, 1}, x)), z = cross(x, y);
    for (const std::array<Vector3, 3>& axis : {std::array{x, y, z}, std::array{x, y, -z}}) {
        const auto surface = cellsOf(ball(12, kGas, axis));
        EXPECT_NEAR(measure(surface).volume_mm3, 4.0 / 3 * M_PI * 1728, 0.01 * 4.0 / 3 * M_PI * 1728);
        for (std::size_t n = 0; n < surface.pointCount(); ++n)
            ASSERT_NEAR(length(surface.point(n) - Point3{}), 12, 0.05);
    }
}

TEST(Cells, AreContiguousRangesInOrderOfTheirSegment)
{
    const Scan scan = ball(12, kGas);
    const auto surface = cellsOf(scan);
    EXPECT_TRUE(std::is_sorted(surface.segment.begin(), surface.segment.end()));
    EXPECT_EQ(surface.segment.front(), 1);
    EXPECT_EQ(surface.segment.back(), 2);
    for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
        const double z = (surface.point(surface.triangles[3 * t]).z + surface.point(surface.triangles[3 * t + 1]).z +
                          surface.point(surface.triangles[3 * t + 2]).z) /
                         3;
        ASSERT_EQ(surface.segment[t], z < -0.7 ? 1 : z > 0.7 ? 2 : surface.segment[t]);
    }
    Subdivision description;
    description.segments.resize(2);
    countTriangles(surface, description);
    EXPECT_EQ(description.segments[0].triangles + description.segments[1].triangles, surface.triangleCount());
    EXPECT_EQ(description.statistics["triangles"], surface.triangleCount());
    EXPECT_NEAR(description.statistics["triangles_average"].get<double>(), double(surface.triangleCount()) / 2, 1e-9);
}

TEST(Cells, HaveNoSurfaceBetweenGasAndFluid)
{
    // A ball half full: gas in front (-y, up when supine), fluid behind, and a blurred layer between that looks like
    // tissue. The surface is the ball's, nothing crosses it.
    const double radius_mm = 16;
    Scan scan = ball(radius_mm, kGas);
    for (std::size_t n = 0; n < scan.hu.voxels.size(); ++n) {
        const Point3 p = scan.hu.grid.pointAt(scan.hu.grid.indexOf(n));
        const double content = kGasHu + (kFluidHu - kGasHu) * beyond(p.y, 0.7);
        const double wall = beyond(length(p - Point3{}) - radius_mm, 0.7);
        scan.hu.voxels[n] = std::int16_t(std::lround(content + (kTissueHu - content) * wall));
        const bool inside = wall < 0.5;
        scan.inside.voxels[n] = !inside ? kOutside : p.y < 0 ? kGas : kFluid;
        scan.segments.voxels[n] = inside ? 1 : 0;
    }
    const auto surface = cellsOf(scan);
    expectClosed(surface);
    const Measures m = measure(surface);
    EXPECT_NEAR(m.area_mm2, 4 * M_PI * radius_mm * radius_mm, 0.02 * 4 * M_PI * radius_mm * radius_mm);
    for (std::size_t n = 0; n < surface.pointCount(); ++n) {
        const Point3 p = surface.point(n);
        // Beside the level the densities of three materials mix and only the mask tells; elsewhere they do.
        ASSERT_NEAR(length(p - Point3{}), radius_mm, std::abs(p.y) < 2 ? 0.5 : 0.05);
        ASSERT_GT(dot(normalAt(surface, n), normalized(Point3{} - p)), std::abs(p.y) < 3 ? 0.4 : 0.99);
    }
}

TEST(Cells, CloseWhereTheScanEndsInsideTheLumen)
{
    Grid grid{.size = {24, 24, 10}};
    Scan scan{HuVolume(grid), InsideVolume(grid), SegmentVolume(grid)};
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Point3 p = grid.pointAt(grid.indexOf(n));
        scan.inside.voxels[n] = std::hypot(p.x - 12, p.y - 12) < 8 ? kGas : kOutside;
        scan.hu.voxels[n] = scan.inside.voxels[n] ? -1000 : 40;
        scan.segments.voxels[n] = scan.inside.voxels[n];
    }
    expectClosed(cellsOf(scan));
}

TEST(Cells, TakeDensitiesFromALargerVolumeOnTheSameLattice)
{
    const Scan scan = ball(10, kGas);
    const InsideVolume inside = partOf(scan.inside, {12, 11, 10}, {40, 42, 44});
    SegmentVolume segments = partOf(scan.segments, {12, 11, 10}, {40, 42, 44});
    const auto cropped = extractCells(scan.hu, inside, segments, {}, quiet);
    const auto whole = cellsOf(scan);
    ASSERT_EQ(cropped.triangles, whole.triangles);
    for (std::size_t n = 0; n < whole.points_mm.size(); ++n)
        ASSERT_NEAR(cropped.points_mm[n], whole.points_mm[n], 1e-4);
    InsideVolume shifted = inside;
    shifted.grid.origin_mm.x += 0.3;
    segments.grid = shifted.grid;
    EXPECT_THROW(extractCells(scan.hu, shifted, segments, {}, quiet), Error);
}

TEST(Cells, DependOnNoMoreThanTheDensitiesAroundTheLumen)
{
    const Scan scan = ball(10, kFluid);
    HuVolume noisy = scan.hu;
    std::mt19937 random(5);
    for (std::int16_t& hu : noisy.voxels)
        hu = std::int16_t(hu + std::uniform_int_distribution(-150, 150)(random));
    // No voxel around the ball: all beyond its faces comes from the densities.
    InsideVolume inside = partOf(scan.inside, {18, 17, 17}, {29, 29, 29});
    const SegmentVolume segments = partOf(scan.segments, {18, 17, 17}, {29, 29, 29});
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        if (inside.voxels[n] && inside.grid.indexOf(n).j < 14)
            inside.voxels[n] = kGas;
    const HuVolume around = densitiesAround(noisy, inside.grid);
    EXPECT_EQ(around.grid.size, (std::array<int, 3>{45, 45, 45}));
    EXPECT_EQ(around.at({8, 8, 8}), noisy.at({18, 17, 17}));
    const auto few = extractCells(around, inside, segments, {}, quiet);
    const auto all = extractCells(noisy, inside, segments, {}, quiet);
    EXPECT_GT(all.triangleCount(), 2000U);
    EXPECT_EQ(few.triangles, all.triangles);
    EXPECT_EQ(few.points_mm, all.points_mm);
    EXPECT_EQ(few.normals, all.normals);
}

TEST(Cells, HaveTheScansLastDensitiesAroundThem)
{
    const Scan scan = ball(10, kGas);
    const HuVolume around = densitiesAround(scan.hu, scan.hu.grid);
    EXPECT_EQ(around.grid.size, scan.hu.grid.size);
    EXPECT_EQ(around.voxels, scan.hu.voxels);
    Grid elsewhere = scan.hu.grid;
    elsewhere.origin_mm.x += 0.3;
    EXPECT_THROW(densitiesAround(scan.hu, elsewhere), Error);
}

TEST(Cells, DoNotDependOnTheNumberOfThreads)
{
    const Scan scan = ball(14, kFluid);
    const auto both = cellsOf(scan);
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto single = cellsOf(scan);
    EXPECT_EQ(single.points_mm, both.points_mm);
    EXPECT_EQ(single.normals, both.normals);
    EXPECT_EQ(single.triangles, both.triangles);
}

TEST(Cells, OfAnEmptyMaskAreEmpty)
{
    const Grid grid{.size = {6, 6, 6}};
    EXPECT_EQ(extractCells(HuVolume(grid), InsideVolume(grid), SegmentVolume(grid), {}, quiet).triangleCount(), 0U);
}

}  // namespace
}  // namespace vicon::steps

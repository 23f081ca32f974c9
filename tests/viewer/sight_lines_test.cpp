#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "test_colon.h"
#include "test_surface.h"
#include "vicon/viewer/model/sight_lines.h"

namespace vicon::viewer {
namespace {

/// The triangle that a ray meets first with its front side.
std::optional<std::size_t> firstTriangle(const CellSurface& surface, Point3 eye, Vector3 way)
{
    std::optional<std::size_t> first;
    double nearest = 1e300;
    for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
        const Point3 a = surface.point(surface.triangles[3 * t]);
        const Vector3 u = surface.point(surface.triangles[3 * t + 1]) - a,
                      v = surface.point(surface.triangles[3 * t + 2]) - a;
        const double facing = dot(cross(u, v), way);
        if (facing >= 0)
            continue;
        const Vector3 to_eye = eye - a, q = cross(to_eye, u);
        const double at = dot(v, q) / dot(cross(way, v), u);
        const double x = dot(to_eye, cross(way, v)) / dot(u, cross(way, v)), y = dot(way, q) / dot(u, cross(way, v));
        if (x >= 0 && y >= 0 && x + y <= 1 && at > 0 && at < nearest) {
            nearest = at;
            first = t;
        }
    }
    return first;
}

std::size_t patchOf(const std::vector<Patch>& patches, std::size_t triangle)
{
    const auto patch = std::find_if(patches.begin(), patches.end(), [&](const Patch& p) {
        return triangle >= p.first_triangle && triangle < p.first_triangle + p.triangles;
    });
    return std::size_t(patch - patches.begin());
}

TEST(Patches, HoldEveryTriangleOnceAndNeverTwoCells)
{
    const std::vector<std::uint16_t> cell{1, 1, 1, 1, 1, 2, 4, 4, 4};
    const auto patches = patchesOf(cell, 2);
    std::size_t next = 0;
    for (const Patch& patch : patches) {
        EXPECT_EQ(patch.first_triangle, next);
        EXPECT_GE(patch.triangles, 1U);
        EXPECT_LE(patch.triangles, 2U);
        for (; next < patch.first_triangle + patch.triangles; ++next)
            EXPECT_EQ(cell[next], patch.cell);
    }
    EXPECT_EQ(next, cell.size());
    EXPECT_TRUE(patchesOf({}).empty());
}

// In every storage of the body: mirrored, oblique, feet first.
TEST(SightLines, TheFirstTriangleOnALineOfSightIsNeverLeftOut)
{
    const Lens lens{90, 200, 160};
    for (const test::Storage& storage : test::storages()) {
        const test::TestColon colon(storage, 3);
        const auto patches = patchesOf(colon.cells.segment, 50);
        const SightLines lines(colon.inside, {colon.cells.points_mm, colon.cells.triangles, patches});
        std::mt19937 random(5);
        std::normal_distribution<double> any;
        std::uniform_int_distribution<std::size_t> pick(0, colon.inside.voxels.size() - 1);
        std::uniform_real_distribution<double> part(0, 1);
        std::size_t poses = 0, drawn = 0, hits = 0;
        while (poses < 12) {
            const std::size_t voxel = pick(random);
            const Point3 eye = colon.inside.grid.pointAt(colon.inside.grid.indexOf(voxel));
            if (colon.inside.voxels[voxel] == kOutside || !lines.holdsAt(eye, 0.5))
                continue;
            ++poses;
            const Pose pose = lookAt(eye, eye + normalized({any(random), any(random), any(random)}),
                                     {any(random), any(random), any(random)});
            const auto seen = lines.visibleFrom(pose, lens);
            for (const std::uint8_t s : seen)
                drawn += s;
            for (int ray = 0; ray < 40; ++ray) {
                const Vector3 way = rayThrough(pose, lens, {200 * part(random), 160 * part(random)});
                if (const auto t = firstTriangle(colon.cells, eye, way)) {
                    ++hits;
                    EXPECT_TRUE(seen[patchOf(patches, *t)]) << storage.name;
                }
            }
        }
        EXPECT_GT(hits, 12U * 40 * 9 / 10) << storage.name;
        EXPECT_LT(double(drawn), 0.4 * double(patches.size() * poses)) << storage.name;  // and yet little is drawn
    }
}

// Two rooms beside each other; the wall between them has a door. What lies behind the wall beside the door is not seen,
// however thin the wall is.
TEST(SightLines, AWallOfOneVoxelHidesWhatIsBehindIt)
{
    for (const int thickness : {1, 2, 3, 6}) {
        InsideVolume inside(Grid{.size = {40, 40, 46 + thickness}});
        for (int k = 2; k < 44 + thickness; ++k)
            for (int j = 2; j < 38; ++j)
                for (int i = 2; i < 38; ++i) {
                    const bool wall = k >= 22 && k < 22 + thickness, door = i < 8 && j < 8;
                    inside.at({i, j, k}) = wall && !door ? kOutside : kGas;
                }
        // Two small triangles on the far wall: opposite the eye, and in line with the door.
        const auto low = float(43.4 + thickness);
        const std::vector<float> points{30, 30, low, 31, 30, low, 30, 31, low, 4, 4, low, 5, 4, low, 4, 5, low};
        const std::vector<std::uint32_t> triangles{0, 1, 2, 3, 4, 5};
        const std::vector<Patch> patches{{0, 1, 1}, {1, 1, 2}};
        const SightLines lines(inside, {points, triangles, patches});
        const Point3 eye{4.5, 4.5, 6};
        const Pose pose = lookAt(eye, {12, 12, 40}, {0, 1, 0});
        ASSERT_TRUE(lines.holdsAt(eye, 0.5));
        const auto seen = lines.visibleFrom(pose, {90, 768, 768});
        EXPECT_FALSE(seen[0]) << thickness;
        EXPECT_TRUE(seen[1]) << thickness;
    }
}

// A hall with half a wall near its far end. Wide bundles would meet what lies far behind the wall's edge.
TEST(SightLines, FarAwayLittleIsMetBehindAnEdge)
{
    InsideVolume inside(Grid{.size = {40, 40, 300}});
    for (int k = 2; k < 298; ++k)
        for (int j = 2; j < 38; ++j)
            for (int i = 2; i < 38; ++i)
                inside.at({i, j, k}) = k >= 250 && k < 253 && i >= 20 ? kOutside : kGas;
    std::vector<float> points;
    std::vector<std::uint32_t> triangles;
    std::vector<Patch> patches;
    for (std::uint32_t n = 0; n < 17; ++n) {  // on the end wall, side by side behind the half wall
        const float x = 20.2F + float(n), z = 297.4F;
        points.insert(points.end(), {x, 20, z, x + 0.5F, 20, z, x, 20.5F, z});
        triangles.insert(triangles.end(), {3 * n, 3 * n + 1, 3 * n + 2});
        patches.push_back({n, 1, 1});
    }
    const SightLines lines(inside, {points, triangles, patches});
    for (const double x : {12.0, 15.0, 17.0, 18.5, 20.0}) {
        const auto seen = lines.visibleFrom(lookAt({x, 20, 6}, {x, 20, 100}, {0, 1, 0}), {90, 768, 768});
        const double shadow = 20 + (20 - x) * (297.4 - 250) / (250 - 6);  // where the edge's shadow begins there
        for (std::size_t n = 0; n < patches.size(); ++n) {
            const double beyond = points[9 * n] - shadow;
            if (beyond < 0) {
                EXPECT_TRUE(seen[n]) << x << " mm, " << beyond << " mm behind the edge";
            }
            if (beyond > 5) {
                EXPECT_FALSE(seen[n]) << x << " mm, " << beyond << " mm behind the edge";
            }
        }
    }
}

TEST(SightLines, NothingIsProvedBesideTheWall)
{
    const test::TestColon colon;
    const auto patches = patchesOf(colon.cells.segment);
    const SightLines lines(colon.inside, {colon.cells.points_mm, colon.cells.triangles, patches});
    const Grid& grid = colon.inside.grid;
    std::size_t tried = 0;
    for (std::size_t n = 0; n < colon.inside.voxels.size(); n += 7) {
        const Index3 v = grid.indexOf(n);
        const bool beside = colon.inside.valueOr(v, kOutside) != kOutside &&
                            colon.inside.valueOr({v.i + 1, v.j, v.k}, kOutside) == kOutside;
        if (!beside)
            continue;
        ++tried;
        EXPECT_FALSE(lines.holdsAt(grid.pointAt(v), 0.1));
    }
    EXPECT_GT(tried, 10U);
}

}  // namespace
}  // namespace vicon::viewer

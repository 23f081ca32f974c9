#include "vicon/cases/polyp_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "polyp_scene.h"
#include "vicon/support/support.h"

namespace vicon {
namespace {

using Sizes = std::vector<double>;
const int kDirections = support::inFull() ? 5 : 1;
constexpr double kBlurs_mm[] = {0.5, 0.7, 0.9};
constexpr double kNoises_hu[] = {0, 10, 20, 30, 40, 60, 80};

constexpr const char *kAll = "all", *kInHead = "anywhere in the head";

PolypOutline outlineOf(const PolypOnWall& wall, double blur_mm)
{
    return outlinePolyp(wall.surface, wall.lumen, wall.click_mm, {blur_mm, 0});
}

/// What was found of many polyps.
struct Tally {
    int polyps = 0, outlined = 0, within = 0, bounded = 0, volume_bounded = 0, in_plane_too = 0;

    void add(const PolypTruth& truth, const PolypOutline& outline)
    {
        constexpr double kWithin_mm = 0.7;
        ++polyps;
        if (!outline.size)
            return;
        const PolypSize& size = *outline.size;
        const auto between = [](double least, double value, double most) { return least <= value && value <= most; };
        ++outlined;
        within += std::abs(size.diameter_mm - truth.diameter_mm) <= kWithin_mm ? 1 : 0;
        bounded += between(size.least_mm, truth.diameter_mm, size.most_mm) ? 1 : 0;
        volume_bounded += between(size.volume_least_ml.value(), truth.volume_ml, size.volume_most_ml.value()) ? 1 : 0;
        const double in_plane_mm = outline.plane ? outline.plane->diameter_mm : 0;
        in_plane_too += in_plane_mm <= size.diameter_mm && size.diameter_mm - in_plane_mm <= kWithin_mm ? 1 : 0;
    }
    double part(int count) const { return double(count) / outlined; }
};

/// By clicks on the wall: of all, and of those of one size, shape, wall or kernel; and by clicks in slices, in the
/// tissue anywhere.
using Tallies = std::map<std::string, Tally>;

std::string kernelName(double blur_mm)
{
    return "blur " + std::to_string(blur_mm).substr(0, 3) + " mm";
}

void print(const Tallies& tallies)
{
    for (const auto& [name, t] : tallies)
        std::printf(
            "%-24s %4d clicks, outlined %.3f, within 0.7 mm %.3f, bounds hold %.3f, of the volume %.3f, 2D as 3D "
            "%.3f\n",
            name.c_str(), t.polyps, double(t.outlined) / t.polyps, t.part(t.within), t.part(t.bounded),
            t.part(t.volume_bounded), t.part(t.in_plane_too));
}

Tallies talliesOf(const Sizes& diameters_mm, unsigned seed)
{
    constexpr std::pair<PolypShape, const char*> kShapes[] = {
        {PolypShape::sessile, "sessile"}, {PolypShape::flat, "flat"}, {PolypShape::stalked, "stalked"}};
    constexpr std::pair<WallShape, const char*> kWalls[] = {{WallShape::plane, "on a plane"},
                                                            {WallShape::tube, "in a tube"},
                                                            {WallShape::outside_bend, "outside of a bend"},
                                                            {WallShape::inside_bend, "inside of a bend"}};
    Tallies tallies;
    const auto add = [&](const PolypScene& scene, const char* shape, const char* wall_shape) {
        const PolypTruth truth = truthOf(scene);
        const PolypOnWall wall = wallOf(scene);
        const PolypOutline outline =
            outlinePolyp(wall.surface, wall.lumen, wall.click_mm, {scene.blur_mm, scene.noise_hu});
        for (const std::string& name :
             {std::string(kAll), std::string(shape), std::string(wall_shape),
              std::to_string(std::lround(scene.diameter_mm)) + " mm", kernelName(scene.blur_mm)})
            tallies[name].add(truth, outline);
        for (const Point3 place : wall.in_head_mm)
            tallies[kInHead].add(truth, outlinePolyp(wall.surface, wall.lumen, place, {scene.blur_mm, scene.noise_hu}));
    };
    for (const double diameter_mm : diameters_mm)
        for (const auto& [shape, shape_name] : kShapes)
            for (const auto& [wall, wall_name] : kWalls)
                for (const double blur_mm : kBlurs_mm)
                    for (int n = 0; n < kDirections; ++n, ++seed)
                        add({shape, wall, diameter_mm, blur_mm, kNoises_hu[seed % std::size(kNoises_hu)], seed},
                            shape_name, wall_name);
    print(tallies);
    return tallies;
}

void expectBounds(const Tally& tally)
{
    constexpr double kClaimed = 0.8;
    const double scatter = 3 * std::sqrt(kClaimed * (1 - kClaimed) / tally.outlined);
    EXPECT_NEAR(tally.part(tally.bounded), kClaimed, std::max(0.04, scatter));
    EXPECT_NEAR(tally.part(tally.volume_bounded), kClaimed, std::max(0.04, scatter));
}

TEST(PolypSize, IsWithinItsBoundsWhateverTheShapeWallDirectionKernelAndNoise)
{
    const Tallies tallies = talliesOf(support::inFull() ? Sizes{6, 7, 8, 10, 12, 15} : Sizes{6, 10, 15}, 40001);
    for (const char* name : {kAll, kInHead}) {
        SCOPED_TRACE(name);
        const Tally& tally = tallies.at(name);
        EXPECT_GE(tally.outlined, 0.85 * tally.polyps);
        EXPECT_GE(tally.within, 0.95 * tally.outlined) << tally.outlined;
        expectBounds(tally);
    }
    for (const double blur_mm : kBlurs_mm) {
        const Tally& tally = tallies.at(kernelName(blur_mm));
        EXPECT_GE(tally.within, 0.95 * tally.outlined) << blur_mm;
    }
    const Tally& all = tallies.at(kAll);
    EXPECT_GE(all.in_plane_too, 0.9 * all.outlined) << "what is round is as large in the best plane";
}

class PolypBounds : public testing::TestWithParam<int> {};

TEST_P(PolypBounds, HoldOfSmallAndLargeOnesToo)
{
    const int diameter_mm = GetParam();
    if (diameter_mm > 20 && !support::inFull())
        return;  // these take long
    const Tallies tallies = talliesOf({double(diameter_mm)}, 45001 + 1000U * unsigned(diameter_mm));
    const Tally& all = tallies.at(kAll);
    constexpr double kOutlined = 0.6;  // of 4 mm; blur closes the smallest stalks
    EXPECT_GE(all.outlined, kOutlined * all.polyps);
    expectBounds(all);
}

INSTANTIATE_TEST_SUITE_P(Millimetres, PolypBounds, testing::Values(4, 5, 20, 25, 30),
                         testing::PrintToStringParamName());

TEST(PolypSize, OfAHalfBallIsItsDiameterHeightAndVolume)
{
    const PolypScene scene{PolypShape::sessile, WallShape::plane, 10, 0.5, 0, 3};
    const PolypOutline outline = outlineOf(wallOf(scene), scene.blur_mm);
    ASSERT_TRUE(outline.size) << outline.trouble;
    EXPECT_NEAR(outline.size->diameter_mm, 10, 0.3);
    EXPECT_NEAR(distance(outline.size->from_mm, outline.size->to_mm), outline.size->diameter_mm, 1e-6);
    EXPECT_NEAR(outline.size->height_mm, 5, 0.5);
    EXPECT_NEAR(outline.size->volume_ml, 0.262, 0.03);
    EXPECT_LT(*outline.size->volume_least_ml, outline.size->volume_ml);
    EXPECT_GT(*outline.size->volume_most_ml, outline.size->volume_ml);
    EXPECT_GE(outline.size->rim_mm.size(), 40U);
}

/// The largest chord of the half ellipsoid in planes across the axes.
double largestInPlanes_mm(const PolypScene& scene, const PolypOnWall& wall)
{
    const Vector3 half = Vector3{scene.longer, 1, 1} * (scene.diameter_mm / 2);
    std::vector<Vector3> head;
    for (double down = 0; down <= 90; down += 5)
        for (double around = 0; around < 360; around += 3) {
            const double theta = down * M_PI / 180, phi = around * M_PI / 180;
            head.push_back(wall.along * (half.x * std::sin(theta) * std::cos(phi)) +
                           cross(wall.up, wall.along) * (half.y * std::sin(theta) * std::sin(phi)) +
                           wall.up * (half.z * std::cos(theta)));
        }
    constexpr double kSame_mm = 0.1;
    double most = 0;
    for (const Vector3& a : head)
        for (const Vector3& b : head) {
            const Vector3 d = a - b;
            if (std::min({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < kSame_mm)
                most = std::max(most, length(d));
        }
    return most;
}

TEST(PolypSize, InTheBestPlaneIsTheLargestDiameterAcrossAnAxis)
{
    double most_apart_mm = 0;
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
        const PolypScene scene{
            .shape = PolypShape::sessile, .diameter_mm = 7, .blur_mm = 0.5, .seed = seed, .longer = 2};
        const PolypOnWall wall = wallOf(scene);
        const PolypOutline outline = outlineOf(wall, scene.blur_mm);
        ASSERT_TRUE(outline.size && outline.plane) << outline.trouble;
        const PlaneSize& plane = *outline.plane;
        const double truth_mm = largestInPlanes_mm(scene, wall);
        EXPECT_NEAR(outline.size->diameter_mm, 14, 0.7) << seed;
        EXPECT_NEAR(plane.diameter_mm, truth_mm, 1) << seed;
        EXPECT_NEAR(distance(plane.from_mm, plane.to_mm), plane.diameter_mm, 1e-6);
        const Vector3 normal = cross(plane.along, plane.up);
        EXPECT_NEAR(std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}), 1, 1e-6);
        EXPECT_GE(dot(plane.up, wall.up), 0) << "into the lumen";
        EXPECT_GT(plane.area_mm2, 0);
        EXPECT_NEAR(sizeOf(outline).plane->diameter_mm, plane.diameter_mm, 0);
        most_apart_mm = std::max(most_apart_mm, 14 - truth_mm);
    }
    EXPECT_GT(most_apart_mm, 1) << "some lie so that no plane shows them whole";
}

TEST(PolypSize, OnAFoldItSaysThatThereIsNoOutlineButOfAHeadOnAStalk)
{
    for (const double diameter_mm : {4.0, 6.0, 10.0, 15.0, 20.0}) {
        for (const PolypShape shape : {PolypShape::sessile, PolypShape::flat}) {
            const PolypOutline outline = outlineOf(wallOf({shape, WallShape::fold, diameter_mm, 0.7, 0, 5}), 0.7);
            EXPECT_FALSE(outline.size) << diameter_mm;
            EXPECT_EQ(outline.trouble, "its edge lies on a fold, or on another polyp") << diameter_mm;
        }
        const PolypOutline head =
            outlineOf(wallOf({PolypShape::stalked, WallShape::fold, diameter_mm, 0.5, 0, 5}), 0.5);
        EXPECT_TRUE(diameter_mm < 6 || head.size) << head.trouble;
        EXPECT_NEAR(head.size ? head.size->diameter_mm : diameter_mm, diameter_mm, 0.7);
    }
}

TEST(PolypSize, AgainstAnotherPolypItSaysThatThereIsNoOutline)
{
    unsigned seed = 50001;
    for (const double diameter_mm : {8.0, 12.0})
        for (const double apart : {0.85, 1.0})
            for (const double blur_mm : {0.5, 0.7, 0.9}) {
                const PolypScene scene{.diameter_mm = diameter_mm, .blur_mm = blur_mm, .seed = ++seed, .apart = apart};
                const PolypOutline outline = outlineOf(wallOf(scene), blur_mm);
                EXPECT_FALSE(outline.size) << diameter_mm << " mm, " << apart << " apart, blur " << blur_mm;
                EXPECT_EQ(outline.trouble, "its edge lies on a fold, or on another polyp");
            }
    const PolypScene away{.diameter_mm = 8, .blur_mm = 0.7, .seed = 50001, .apart = 1.6};
    EXPECT_TRUE(outlineOf(wallOf(away), 0.7).size) << "wall lies between them";
}

TEST(PolypSize, UnderFluidItSaysSoAndAboveItIsOutlined)
{
    const double nowhere = std::numeric_limits<double>::infinity();
    const struct {
        double fluid_from_mm;
        const char* trouble;
    } cases[] = {{-60, "it lies under fluid"}, {0, "it lies in part under fluid"}, {nowhere, ""}};
    for (const auto& c : cases)
        for (const double diameter_mm : {6.0, 10.0, 15.0}) {
            const PolypScene scene{
                .wall = WallShape::tube, .diameter_mm = diameter_mm, .seed = 7, .fluid_from_mm = c.fluid_from_mm};
            const PolypOutline outline = outlineOf(wallOf(scene), scene.blur_mm);
            EXPECT_EQ(outline.trouble, c.trouble) << diameter_mm;
            EXPECT_EQ(outline.size.has_value(), outline.trouble.empty());
        }
}

TEST(PolypSize, OfABareWallIsNone)
{
    PolypScene scene{PolypShape::sessile, WallShape::tube, 8, 0.7, 10, 6};
    const PolypOnWall wall = wallOf(scene);
    Point3 farthest = wall.click_mm;  // from the polyp, but not at the scene's border
    for (std::size_t n = 0; n < wall.surface.pointCount(); ++n)
        if (const double d = distance(wall.surface.point(n), wall.click_mm);
            d < 11 && d > distance(farthest, wall.click_mm))
            farthest = wall.surface.point(n);
    const PolypOutline outline = outlinePolyp(wall.surface, wall.lumen, farthest, {scene.blur_mm, scene.noise_hu});
    EXPECT_FALSE(outline.size && outline.size->diameter_mm < 5) << "no polyp is made up";
    const Point3 far_away = wall.click_mm + Vector3{0, 0, 100};
    EXPECT_FALSE(outlinePolyp(wall.surface, wall.lumen, far_away, {}).size);
}

}  // namespace
}  // namespace vicon

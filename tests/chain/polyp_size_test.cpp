#include "vicon/cases/polyp_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "polyp_scene.h"
#include "vicon/support/support.h"

namespace vicon {
namespace {

const int kDirections = support::inFull() ? 5 : 1;

/// What was found of many polyps.
struct Tally {
    int polyps = 0, outlined = 0, within = 0, bounded = 0;

    void add(const PolypScene& scene, const PolypOutline& outline)
    {
        constexpr double kWithin_mm = 0.7;
        ++polyps;
        if (!outline.size)
            return;
        const PolypSize& size = *outline.size;
        ++outlined;
        within += std::abs(size.diameter_mm - scene.diameter_mm) <= kWithin_mm ? 1 : 0;
        bounded += size.least_mm <= scene.diameter_mm && scene.diameter_mm <= size.most_mm ? 1 : 0;
    }
};

/// By clicks on the wall, and by clicks in slices, in the tissue anywhere.
struct Tallies {
    Tally on_wall, in_head;
};

Tallies tallyOf(const std::vector<double>& diameters_mm, unsigned seed)
{
    Tallies tallies;
    const auto add = [&](const PolypScene& scene) {
        const PolypOnWall wall = wallOf(scene);
        tallies.on_wall.add(scene, outlinePolyp(wall.surface, wall.click_mm, scene.blur_mm));
        for (const Point3 place : wall.in_head_mm)
            tallies.in_head.add(scene, outlinePolyp(wall.surface, place, scene.blur_mm));
    };
    for (const double diameter_mm : diameters_mm)
        for (const PolypShape shape : {PolypShape::sessile, PolypShape::flat, PolypShape::stalked})
            for (const WallShape wall : {WallShape::plane, WallShape::tube})
                for (const double blur_mm : {0.5, 0.7, 0.9})
                    for (int n = 0; n < kDirections; ++n, ++seed)
                        add({shape, wall, diameter_mm, blur_mm, 10.0 * (seed % 4), seed});
    return tallies;
}

TEST(PolypSize, IsWithinItsBoundsWhateverTheShapeDirectionKernelAndNoise)
{
    const Tallies tallies = tallyOf({6, 7, 8, 10, 12, 15}, 40001);
    for (const auto& [name, tally] : {std::pair("on wall", tallies.on_wall), std::pair("in head", tallies.in_head)}) {
        SCOPED_TRACE(name);
        std::cout << name << ": " << tally.polyps << " clicks, " << tally.outlined << " outlined, " << tally.within
                  << " within, " << tally.bounded << " bounded\n";
        EXPECT_GE(tally.outlined, 0.85 * tally.polyps);
        EXPECT_GE(tally.within, 0.95 * tally.outlined) << tally.outlined;
        constexpr double kClaimed = 0.8;
        const double scatter = 3 * std::sqrt(kClaimed * (1 - kClaimed) / tally.outlined);
        EXPECT_NEAR(double(tally.bounded) / tally.outlined, kClaimed, std::max(0.04, scatter));
    }
}

TEST(PolypSize, OfAHalfBallIsItsDiameterHeightAndVolume)
{
    const PolypScene scene{PolypShape::sessile, WallShape::plane, 10, 0.5, 0, 3};
    const PolypOnWall wall = wallOf(scene);
    const PolypOutline outline = outlinePolyp(wall.surface, wall.click_mm, scene.blur_mm);
    ASSERT_TRUE(outline.size) << outline.trouble;
    EXPECT_NEAR(outline.size->diameter_mm, 10, 0.3);
    EXPECT_NEAR(distance(outline.size->from_mm, outline.size->to_mm), outline.size->diameter_mm, 1e-6);
    EXPECT_NEAR(outline.size->height_mm, 5, 0.5);
    EXPECT_NEAR(outline.size->volume_ml, 0.262, 0.03);
    EXPECT_GE(outline.size->rim_mm.size(), 40U);
}

TEST(PolypSize, OnAFoldItSaysThatThereIsNoOutline)
{
    for (const double diameter_mm : {6.0, 10.0, 15.0}) {
        const PolypOnWall wall = wallOf({PolypShape::sessile, WallShape::fold, diameter_mm, 0.7, 0, 5});
        const PolypOutline outline = outlinePolyp(wall.surface, wall.click_mm, 0.7);
        EXPECT_FALSE(outline.size) << diameter_mm;
        EXPECT_FALSE(outline.trouble.empty());
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
    const PolypOutline outline = outlinePolyp(wall.surface, farthest, scene.blur_mm);
    EXPECT_FALSE(outline.size && outline.size->diameter_mm < 5) << "no polyp is made up";
    EXPECT_FALSE(outlinePolyp(wall.surface, wall.click_mm + Vector3{0, 0, 100}, scene.blur_mm).size);
}

}  // namespace
}  // namespace vicon

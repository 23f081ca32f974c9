// Where the picture of a band is hatched.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "band_shade.h"
#include "bent_tube.h"
#include "vicon/viewer/model/band_raster.h"

namespace vicon::viewer {
namespace {

constexpr double kBend_mm = 20, kTube_mm = 15;
constexpr int kEvery_px = 9;  // a line of the hatch, along x and along y

/// The wall of a tube that is bent, painted without what was seen and without openness.
struct PaintedTube {
    test::BentTube tube;
    PathFrames path;
    NoProgress quiet;
    BandMap band;
    BandRaster raster;
    Picture picture;

    explicit PaintedTube(bool folds)
        : tube(kBend_mm, kTube_mm, {}, 3, folds),
          path(tube.skeleton),
          band(tube.surface, path, tube.exit_distance, quiet),
          raster(band, pageOf(band)),
          picture(bandWall(band, raster, 1, {}, {}, quiet))
    {
    }
    static BandPage pageOf(const BandMap& band)
    {
        BandPage page;
        page.width = 900;
        page.height = 500;
        return wholeBand(band, page);
    }
    /// The wall has one hue, brighter and darker: bluer than that is a line of the hatch.
    bool hatched(int x, int y) const
    {
        constexpr double kBlueOfRed = 0.56 / 0.93;
        constexpr int kBluer = 25;  // half of what the line adds
        const Rgb color = picture.at(x, y);
        return color.blue - kBlueOfRed * color.red > kBluer;
    }
    bool onLine(int x, int y) const { return (x + y) % kEvery_px == 0; }
    double factorAt(const TriangleRaster::Hit& hit) const
    {
        double factor = 0;
        for (std::size_t k = 0; k < 3; ++k)
            factor += band.areaFactor(tube.surface.triangles[3 * std::size_t(hit.triangle) + k]) * hit.weights[k];
        return factor;
    }
    /// Calls it with each pixel that shows wall once around.
    template <class Do>
    void forEachPixel(Do what) const
    {
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const double around_rad = raster.page().placeAt(band, {x + 0.5, y + 0.5}).around_rad;
                if (const auto hit = raster.at(x, y); hit && std::abs(around_rad) < std::numbers::pi)
                    what(x, y, *hit);
            }
    }
};

TEST(BandHatch, LiesWhereAreasAreOffByMoreThanAFactorOfTwoAndNowhereElse)
{
    int larger = 0, smaller = 0, kept = 0;
    for (const bool folds : {false, true}) {
        const PaintedTube painted(folds);
        painted.forEachPixel([&](int x, int y, const TriangleRaster::Hit& hit) {
            const double factor = painted.factorAt(hit);
            const bool off = factor < 0.5 || factor > 2;
            ASSERT_EQ(painted.hatched(x, y), off && painted.onLine(x, y)) << x << ", " << y << ": " << factor;
            ++(factor > 2 ? larger : factor < 0.5 ? smaller : kept);
        });
    }
    EXPECT_GT(larger, 1000);
    EXPECT_GT(smaller, 1000);
    EXPECT_GT(kept, 100000);
}

TEST(BandHatch, OfABendLiesOnItsInsideAsTheClosedFormSays)
{
    const PaintedTube painted(false);
    int inside = 0, beside = 0, straight = 0, lines = 0;
    painted.forEachPixel([&](int x, int y, const TriangleRaster::Hit& hit) {
        const Point3 p = pointOf(painted.tube.surface, hit);
        if (p.y < -10 && p.y > -50) {  // off the bend and off the closed ends
            ++straight;
            EXPECT_FALSE(painted.hatched(x, y)) << x << ", " << y;
        }
        if (p.y < 0.7 * std::hypot(p.x, p.y))  // off the bend's ends
            return;
        // The wall's length over the path's is its distance from the bend's axis over that of the path.
        const double factor = kBend_mm / std::hypot(p.x, p.y);
        if (factor > 3) {  // far enough from two: places are evened out over some millimetres
            ++inside;
            lines += painted.onLine(x, y);
            EXPECT_EQ(painted.hatched(x, y), painted.onLine(x, y)) << x << ", " << y << ": " << factor;
        } else if (factor > 0.75 && factor < 1.5) {
            ++beside;
            EXPECT_FALSE(painted.hatched(x, y)) << x << ", " << y << ": " << factor;
        }
    });
    EXPECT_GT(inside, 1000);
    EXPECT_GT(lines, 100);
    EXPECT_GT(beside, 10000);
    EXPECT_GT(straight, 10000);
}

}  // namespace
}  // namespace vicon::viewer

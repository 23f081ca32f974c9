#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace vicon::viewer {
namespace {

constexpr double kReach_mm = 45, kTriangle_mm = 0.8;
constexpr std::array kMucosa{0.93, 0.66, 0.56};
const Pose kPose;  // at the origin, looking along y
const Lens kLens{90, 200, 200};

/// A wall across the direction of view that fills the picture, with this normal all over.
CellSurface wallAt(double depth_mm, Vector3 normal)
{
    const int cells = int(std::ceil(2.2 * depth_mm / kTriangle_mm));
    CellSurface wall;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            for (const double v : {(i - cells / 2.0) * kTriangle_mm, depth_mm, (j - cells / 2.0) * kTriangle_mm})
                wall.points_mm.push_back(float(v));
            for (const double v : {normal.x, normal.y, normal.z})
                wall.normals.push_back(float(v));
        }
    const auto number = [&](int i, int j) { return std::uint32_t(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i)
            for (const std::uint32_t p : {number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j),
                                          number(i + 1, j + 1), number(i, j + 1)})
                wall.triangles.push_back(p);
    wall.segment.assign(wall.triangles.size() / 3, 1);
    return wall;
}

/// What the lamp is meant to show of it, worked out for the pixel alone.
double lit(double depth_mm, Vector3 normal, int x, int y, std::size_t channel)
{
    const Vector3 way = rayThrough(kPose, kLens, {x + 0.5, y + 0.5});
    const double away_mm = depth_mm / dot(way, kPose.forward);
    const double facing = std::max(0.0, -dot(normal, way));
    const double fade = 1 / (1 + away_mm * away_mm / (kReach_mm * kReach_mm));
    const double light = kMucosa[channel] * (0.16 + 0.84 * facing) + 0.09 * std::pow(facing, 40);
    return std::min(255.0, 255 * light * std::sqrt(1.12 * fade));
}

double worstGreyLevels(double depth_mm, Vector3 normal, const Picture& picture, double share = 1)
{
    double worst = 0;
    for (int y = 0; y < kLens.height; ++y)
        for (int x = 0; x < kLens.width; ++x) {
            const Rgb c = picture.at(x, y);
            const std::array<int, 3> shown{c.red, c.green, c.blue};
            for (std::size_t n = 0; n < 3; ++n)
                worst = std::max(worst, std::abs(shown[n] - share * lit(depth_mm, normal, x, y, n)));
        }
    return worst;
}

/// Back to the eye, turned aside.
Vector3 turned(double angle_deg)
{
    return {std::sin(radians(angle_deg)), -std::cos(radians(angle_deg)), 0};
}

struct Lamp : testing::TestWithParam<double> {};

TEST_P(Lamp, ShadesEachPixelOfAFarWallByItsAngleAndDistance)
{
    constexpr double kDepth_mm = 20;
    SurfaceScene scene(wallAt(kDepth_mm, turned(GetParam())));
    Offscreen offscreen(scene.renderer());
    scene.lookFrom(kPose, kLens.view_angle_deg);
    EXPECT_LT(worstGreyLevels(kDepth_mm, turned(GetParam()), offscreen.render(kLens.width, kLens.height)), 1.5);
}

TEST_P(Lamp, ShinesRoundOnANearWallWhoseTrianglesAreLarge)
{
    constexpr double kDepth_mm = 2.5;  // a triangle is seen at an angle of 18 degrees
    SurfaceScene scene(wallAt(kDepth_mm, turned(GetParam())));
    Offscreen offscreen(scene.renderer());
    scene.lookFrom(kPose, kLens.view_angle_deg);
    EXPECT_LT(worstGreyLevels(kDepth_mm, turned(GetParam()), offscreen.render(kLens.width, kLens.height)), 5);
}

INSTANTIATE_TEST_SUITE_P(Turned, Lamp, testing::Values(0.0, 25.0, 50.0, 80.0, 110.0),
                         [](const auto& info) { return "by_" + std::to_string(int(info.param)) + "_degrees"; });

TEST(LampLight, IsTakenAwayWhereTheWallIsClosedAndGivenBack)
{
    constexpr double kDepth_mm = 20;
    const CellSurface wall = wallAt(kDepth_mm, turned(0));
    SurfaceScene scene(wall);
    Offscreen offscreen(scene.renderer());
    scene.lookFrom(kPose, kLens.view_angle_deg);
    const auto shade = [&] { return offscreen.render(kLens.width, kLens.height); };
    const Picture plain = shade();
    scene.shadeByOpenness(wall, std::vector<float>(wall.pointCount(), 0.F));
    EXPECT_LT(worstGreyLevels(kDepth_mm, turned(0), shade(), 0.35), 1.5);
    scene.shadeEvenly();
    EXPECT_EQ(shade().rgb, plain.rgb);
}

Rgb middleOf(const Picture& picture)
{
    return picture.at(picture.width / 2, picture.height / 2);
}

TEST(LampColors, AreThoseThatWereChosen)
{
    const auto colorAt = [](double depth_mm, WallColors colors) {
        SurfaceScene scene(wallAt(depth_mm, turned(0)));
        Offscreen offscreen(scene.renderer());
        scene.lookFrom(kPose, kLens.view_angle_deg);
        scene.setColors(colors);
        return middleOf(offscreen.render(kLens.width, kLens.height));
    };
    const Rgb mucosa = colorAt(20, WallColors::mucosa), bone = colorAt(20, WallColors::bone);
    EXPECT_GT(mucosa.red, mucosa.blue * 4 / 3) << "pink";
    EXPECT_LT(bone.red, bone.blue * 6 / 5) << "white";
    const Rgb near = colorAt(5, WallColors::depth), far = colorAt(100, WallColors::depth);
    EXPECT_GT(near.red, near.blue) << "warm";
    EXPECT_GT(far.blue, far.red * 2) << "blue";
}

TEST(LampColors, AreDrawnTowardsBlueWhereTaggingTouchesTheWallAndGivenBack)
{
    const CellSurface wall = wallAt(20, turned(0));
    SurfaceScene scene(wall);
    Offscreen offscreen(scene.renderer());
    scene.lookFrom(kPose, kLens.view_angle_deg);
    const auto draw = [&] { return offscreen.render(kLens.width, kLens.height); };
    const Picture plain = draw();
    scene.tintTagging(wall, std::vector<float>(wall.pointCount(), 1.F));
    const Rgb tinted = middleOf(draw()), before = middleOf(plain);
    EXPECT_LT(tinted.red, before.red - 20);
    EXPECT_GT(tinted.blue, before.blue + 20);
    scene.tintNothing();
    EXPECT_EQ(draw().rgb, plain.rgb);
}

TEST(LampColors, OfWallThatNoTaggingTouchesAreTheSame)
{
    const CellSurface wall = wallAt(20, turned(0));
    SurfaceScene scene(wall);
    Offscreen offscreen(scene.renderer());
    scene.lookFrom(kPose, kLens.view_angle_deg);
    const Picture plain = offscreen.render(kLens.width, kLens.height);
    scene.tintTagging(wall, std::vector<float>(wall.pointCount(), 0.F));
    EXPECT_EQ(offscreen.render(kLens.width, kLens.height).rgb, plain.rgb);
}

TEST(LampLight, ReachesFartherWhenAskedTo)
{
    SurfaceScene scene(wallAt(40, turned(0)));
    Offscreen offscreen(scene.renderer());
    scene.lookFrom(kPose, kLens.view_angle_deg);
    const int near = offscreen.render(kLens.width, kLens.height).at(100, 100).red;
    scene.setLampReach(90);
    EXPECT_GT(offscreen.render(kLens.width, kLens.height).at(100, 100).red, near + 40);
}

}  // namespace
}  // namespace vicon::viewer

// What flat pictures of the wall are made with: the raster, the unfolded cube, the turned view.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/cube.h"
#include "vicon/viewer/model/triangle_raster.h"
#include "vicon/viewer/model/turned_view.h"

namespace vicon::viewer {
namespace {

TriangleRaster drawn(const std::vector<FlatTriangle>& triangles, int width, int height)
{
    TriangleRaster raster(width, height);
    raster.draw(triangles.size(), [&](std::size_t n, std::vector<FlatTriangle>& out) { out.push_back(triangles[n]); });
    return raster;
}

TEST(TriangleRaster, FillsASquareWithoutAGapAndTheNearerHidesTheFarther)
{
    const FlatTriangle upper{7, {{{2, 2, 5}, {12, 2, 5}, {2, 12, 5}}}},
        lower{8, {{{12, 2, 5}, {12, 12, 5}, {2, 12, 5}}}};
    const FlatTriangle before{9, {{{0, 0, 1}, {6, 0, 1}, {0, 6, 1}}}};
    const TriangleRaster raster = drawn({upper, lower, before}, 16, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const auto hit = raster.at(x, y);
            const bool in_square = x >= 2 && x < 12 && y >= 2 && y < 12, in_before = x + y + 1 <= 6;
            ASSERT_EQ(hit.has_value(), in_square || in_before) << x << ", " << y;
            if (hit) {
                EXPECT_EQ(hit->triangle == 9, in_before) << x << ", " << y;
                EXPECT_NEAR(hit->weights[0] + hit->weights[1] + hit->weights[2], 1, 1e-12);
            }
        }
}

TEST(TriangleRaster, WeightsGiveThePlaceBack)
{
    const FlatTriangle t{0, {{{1, 3, 2}, {37, 9, 4}, {11, 29, 8}}}};
    const TriangleRaster raster = drawn({t}, 40, 40);
    int hits = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x)
            if (const auto hit = raster.at(x, y)) {
                ++hits;
                double px = 0, py = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    px += hit->weights[k] * t.corners[k].x;
                    py += hit->weights[k] * t.corners[k].y;
                }
                EXPECT_NEAR(px, x + 0.5, 1e-4);
                EXPECT_NEAR(py, y + 0.5, 1e-4);
            }
    EXPECT_NEAR(hits, 438, 30) << "half of 36 by 26 less 10 by 6";
}

const Pose kEye{{10, -20, 30}, normalized({1, 2, 2}), uprightOn(normalized({1, 2, 2}), {0, 0, 1})};

TEST(Cube, EveryDirectionIsOnOneFaceAndComesBack)
{
    const CubeLayout layout(800, 600);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 500; ++n) {
        const Vector3 direction = normalized({normal(random), normal(random), normal(random)});
        const Pixel at = layout.toPixel(kEye, kEye.eye_mm + direction * 40);
        ASSERT_TRUE(layout.faceAt(at)) << at.x << ", " << at.y;
        EXPECT_LT(length(*layout.rayThrough(kEye, at) - direction), 1e-9);
    }
    EXPECT_FALSE(layout.faceAt({10, 10}));
    EXPECT_FALSE(layout.rayThrough(kEye, {790, 590}));
}

TEST(Cube, FacesAreWhereTheyAreSaidToBeAndGoOnAcrossTheirEdges)
{
    const CubeLayout layout(800, 600);
    const auto pixelOf = [&](Vector3 d) { return layout.toPixel(kEye, kEye.eye_mm + d); };
    const Vector3 right = kEye.right(), up = kEye.up, front = kEye.forward;
    const auto near = [](Pixel a, Pixel b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-6; };
    EXPECT_TRUE(near(pixelOf(front), {300, 300}));
    EXPECT_TRUE(near(pixelOf(-right), {100, 300}));
    EXPECT_TRUE(near(pixelOf(right), {500, 300}));
    EXPECT_TRUE(near(pixelOf(-front), {700, 300}));
    EXPECT_TRUE(near(pixelOf(up), {300, 100}));
    EXPECT_TRUE(near(pixelOf(-up), {300, 500}));
    // A hair to either side of an edge.
    for (const auto& [a, b] : {std::pair(front, right), std::pair(front, -right), std::pair(front, up),
                               std::pair(front, -up), std::pair(right, -front)}) {
        const Pixel one = pixelOf(a * 1.001 + b), other = pixelOf(a + b * 1.001);
        EXPECT_LT(std::hypot(one.x - other.x, one.y - other.y), 1) << one.x << ", " << one.y;
    }
}

TEST(Cube, ALineIsCutWhereItGoesFromOneFaceToAnotherAndIsWhole)
{
    const CubeLayout layout(800, 600);
    std::mt19937 random(6);
    std::normal_distribution<double> normal(0, 30);
    const auto somewhere = [&] { return kEye.eye_mm + Vector3{normal(random), normal(random), normal(random)}; };
    const auto near = [](Pixel a, Pixel b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-6; };
    for (int n = 0; n < 200; ++n) {
        const Point3 from = somewhere(), to = somewhere();
        bool begins = false, ends = false;
        double turned_rad = 0;
        for (const CubeFace face : kCubeFaces) {
            const auto part = layout.partOn(face, kEye, from, to);
            if (!part)
                continue;
            const Pixel corner = layout.cornerOf(face);
            for (const Pixel at : {part->first, part->second}) {
                EXPECT_GE(at.x, corner.x - 1e-6);
                EXPECT_LE(at.x, corner.x + layout.side() + 1e-6);
                EXPECT_GE(at.y, corner.y - 1e-6);
                EXPECT_LE(at.y, corner.y + layout.side() + 1e-6);
            }
            begins = begins || near(part->first, layout.toPixel(kEye, from));
            ends = ends || near(part->second, layout.toPixel(kEye, to));
            const auto ray = [&](Pixel at) {
                return rayThrough(poseOf(face, kEye), layout.lens(), {at.x - corner.x, at.y - corner.y});
            };
            turned_rad += std::acos(std::clamp(dot(ray(part->first), ray(part->second)), -1.0, 1.0));
        }
        EXPECT_TRUE(begins && ends);
        const double whole_rad = std::acos(dot(normalized(from - kEye.eye_mm), normalized(to - kEye.eye_mm)));
        EXPECT_NEAR(turned_rad, whole_rad, 1e-3) << "nothing is missing, nothing is drawn twice";
    }
}

TEST(TurnedView, WhatIsNearestFollowsTheHand)
{
    const test::TestColon colon(test::storages().front(), 4);
    TurnedView view;
    const PlaneView front = view.over(colon.cells, 400, 400);
    EXPECT_EQ(front.right, axesOf(SlicePlane::coronal).right);
    EXPECT_EQ(front.down, axesOf(SlicePlane::coronal).down);
    const Point3 nearest = front.centre_mm - front.forward() * 50;
    view.turn({20, 0}, 200);
    const Pixel right = view.over(colon.cells, 400, 400).toPixel(nearest);
    EXPECT_GT(right.x, 200 + 5);
    EXPECT_NEAR(right.y, 200, 1e-6);
    view.reset();
    view.turn({0, 20}, 200);
    EXPECT_GT(view.over(colon.cells, 400, 400).toPixel(nearest).y, 200 + 5);
    EXPECT_FALSE(view.fromFront());
    view.reset();
    EXPECT_TRUE(view.fromFront());
}

TEST(TurnedView, IsNeverMirroredAndFitsHoweverItIsTurned)
{
    const test::TestColon colon(test::storages().front(), 4);
    TurnedView view;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> by(-90, 90);
    for (int n = 0; n < 40; ++n) {
        view.turn({by(random), by(random)}, 200);
        const PlaneView plane = view.over(colon.cells, 500, 400);
        EXPECT_NEAR(dot(plane.right, plane.down), 0, 1e-9);
        EXPECT_NEAR(length(plane.right), 1, 1e-9);
        EXPECT_NEAR(length(plane.down), 1, 1e-9);
        for (std::size_t p = 0; p < colon.cells.pointCount(); p += 97) {
            const Pixel at = plane.toPixel(colon.cells.point(p));
            EXPECT_TRUE(at.x >= 0 && at.y >= 0 && at.x <= 500 && at.y <= 400) << at.x << ", " << at.y;
        }
    }
}

TEST(TurnedView, GrowsAroundThePlaceOfTheMouse)
{
    const test::TestColon colon(test::storages().front(), 4);
    TurnedView view;
    view.turn({30, 40}, 200);
    view.move({5, -8});
    const PlaneView before = view.over(colon.cells, 400, 400);
    const Pixel mouse{310, 120};
    const Point3 under = before.pointAt(mouse);
    view.zoom(3, {(mouse.x - 200) * before.mm_per_pixel, (mouse.y - 200) * before.mm_per_pixel});
    const PlaneView after = view.over(colon.cells, 400, 400);
    EXPECT_LT(after.mm_per_pixel, before.mm_per_pixel / 1.5);
    EXPECT_NEAR(after.toPixel(under).x, mouse.x, 1e-6);
    EXPECT_NEAR(after.toPixel(under).y, mouse.y, 1e-6);
}

}  // namespace
}  // namespace vicon::viewer

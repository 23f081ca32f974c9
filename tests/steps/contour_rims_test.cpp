// A fold hardly thicker than a voxel has an even rim.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "grid/wall_values.h"
#include "subdivide/contour.h"
#include "vicon/core/geometry.h"

namespace vicon::steps {
namespace {

constexpr int kSize = 40;
constexpr double kSigma = 1;    // of the blur, in voxels
constexpr double kHalf = 0.85;  // of the fold's thickness: its middle holds 0.6
const Vector3 kAcross = normalized(Vector3{1, 0.37, 0.23});
const Vector3 kAlong = normalized(cross(kAcross, Vector3{0.31, -0.2, 1}));
const Vector3 kOut = cross(kAlong, kAcross);  // towards the rim

double below(double x)
{
    return 0.5 * std::erfc(-x / (std::sqrt(2.0) * kSigma));
}

/// How much of a place is tissue: a fold that ends at 0.
double foldAt(Vector3 p)
{
    const double u = dot(p, kAcross);
    return (below(u + kHalf) - below(u - kHalf)) * below(-dot(p, kOut));
}

double ballAt(Vector3 p)
{
    return below(length(p) - 12);
}

/// As tissueValues() makes it: positive in tissue, one more voxel on every side.
Volume<std::int16_t> fieldOf(const std::function<double(Vector3)>& tissue)
{
    Volume<std::int16_t> field(Grid{.size = {kSize + 2, kSize + 2, kSize + 2}}, std::int16_t(kWallScale));
    for (int k = 0; k < kSize; ++k)
        for (int j = 0; j < kSize; ++j)
            for (int i = 0; i < kSize; ++i) {
                const Vector3 p = Vector3{double(i), double(j), double(k)} - Vector3{1, 1, 1} * ((kSize - 1) / 2.0);
                field.at({i + 1, j + 1, k + 1}) = std::int16_t(std::lround((2 * tissue(p) - 1) * kWallScale));
            }
    return field;
}

Vector3 pointOf(const Contour& contour, std::uint32_t n)
{
    return Vector3{contour.points[3 * std::size_t(n)], contour.points[3 * std::size_t(n) + 1],
                   contour.points[3 * std::size_t(n) + 2]} -
           Vector3{1, 1, 1} * ((kSize - 1) / 2.0);
}

/// How far the rim, seen across the fold, goes in and out: of points and middles of edges, a voxel at a time.
double unevenness(const Contour& contour)
{
    std::map<int, double> farthest;
    for (std::size_t t = 0; t < contour.triangleCount(); ++t)
        for (std::size_t n = 0; n < 3; ++n) {
            const Vector3 a = pointOf(contour, contour.triangles[3 * t + n]),
                          b = pointOf(contour, contour.triangles[3 * t + (n + 1) % 3]);
            for (const double share : {0.0, 0.25, 0.5, 0.75}) {
                const Vector3 p = a + (b - a) * share;
                if (std::abs(dot(p, kAlong)) > 10 || std::abs(dot(p, kAcross)) > 3 || std::abs(dot(p, kOut)) > 5)
                    continue;
                const auto at = farthest.try_emplace(int(std::floor(2 * dot(p, kAlong))), -1e9).first;
                at->second = std::max(at->second, dot(p, kOut));
            }
        }
    double least = 1e9, most = -1e9;
    for (const auto& [place, out] : farthest) {
        least = std::min(least, out);
        most = std::max(most, out);
    }
    return most - least;
}

void expectClosed(const Contour& contour)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < contour.triangleCount(); ++t)
        for (std::size_t n = 0; n < 3; ++n)
            ++edges[{contour.triangles[3 * t + n], contour.triangles[3 * t + (n + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
}

TEST(ContourRims, OfAThinFoldAreEvenAndTheSurfaceStaysClosed)
{
    auto field = fieldOf(foldAt);
    Contour contour = contourOf(field);
    const double before = unevenness(contour);
    const std::size_t triangles = contour.triangleCount(), points = contour.pointCount();
    EXPECT_GT(before, 0.4) << "voxels: without division it is a saw";
    divideAtRims(field, contour);
    EXPECT_LT(unevenness(contour), 0.2);
    EXPECT_GT(contour.triangleCount(), triangles);
    EXPECT_EQ(contour.triangleCount() - triangles, 2 * (contour.pointCount() - points)) << "of a closed surface";
    EXPECT_EQ(contour.on_edges, points);
    expectClosed(contour);
    double farthest = 0;
    for (std::uint32_t n = std::uint32_t(points); n < contour.pointCount(); ++n)
        if (std::abs(dot(pointOf(contour, n), kAcross)) < 3 && length(pointOf(contour, n)) < 12)
            farthest = std::max(farthest, std::abs(foldAt(pointOf(contour, n)) - 0.5));
    EXPECT_LT(farthest, 0.03) << "new points lie on the surface";
}

TEST(ContourRims, WhatBendsGentlyIsNotDivided)
{
    auto field = fieldOf(ballAt);
    Contour contour = contourOf(field);
    const std::vector<float> points = contour.points;
    const std::vector<std::uint32_t> triangles = contour.triangles;
    divideAtRims(field, contour);
    EXPECT_EQ(contour.points, points);
    EXPECT_EQ(contour.triangles, triangles);
}

TEST(ContourRims, DoNotDependOnTheNumberOfThreads)
{
    auto field = fieldOf(foldAt);
    Contour one = contourOf(field), two = one;
    {
        const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
        divideAtRims(field, one);
    }
    divideAtRims(field, two);
    EXPECT_EQ(one.points, two.points);
    EXPECT_EQ(one.triangles, two.triangles);
}

}  // namespace
}  // namespace vicon::steps

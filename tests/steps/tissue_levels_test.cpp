#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "tissue_scene.h"
#include "vicon/steps/cells.h"

namespace vicon::steps {
namespace {

constexpr double kMargin_mm = 6;

class AtLevels : public testing::TestWithParam<double> {};

/// Tissue on the far side of a plane that meets the level at an angle.
TEST_P(AtLevels, TheFractionIsRightWhereGasFluidAndWallMeet)
{
    const double angle = GetParam() * std::numbers::pi / 180;
    const Vector3 out{std::sin(angle), std::cos(angle), 0};
    const Scene scene([&](Point3 p) { return dot(p - Point3{}, out) > 0; });
    const TissueResult result = scene.find();
    double squares = 0, ghost = 0;
    int count = 0;
    scene.forEach(result.tissue, kMargin_mm, [&](Point3 p, double found, double truth) {
        if (std::hypot(p.x, p.y) < 3) {
            squares += (found - truth) * (found - truth);
            ++count;
        }
        if (dot(p - Point3{}, out) < -2.5)
            ghost = std::max(ghost, found);
    });
    // Beaches are the worst: over millimetres fluid is thinner than the blur.
    EXPECT_LT(std::sqrt(squares / count), GetParam() < 45 || GetParam() > 135 ? 0.04 : 0.03)
        << GetParam() << " degrees";
    EXPECT_LT(ghost, 0.3) << GetParam() << " degrees";
}

INSTANTIATE_TEST_SUITE_P(Walls, AtLevels, testing::Values(30.0, 45.0, 60.0, 90.0, 120.0, 150.0));

class Risen : public testing::TestWithParam<double> {};

/// Fluid has risen by a millimetre along the wall, which goes on straight all the same.
TEST_P(Risen, FluidIsNoLedgeOfTheWall)
{
    const double angle = GetParam() * std::numbers::pi / 180;
    const Vector3 out{std::sin(angle), std::cos(angle), 0};
    constexpr double kRise_mm = 1, kWidth_mm = 1.5;
    const Scene scene([&](Point3 p) { return dot(p - Point3{}, out) > 0; }, std::function([&](Point3 p) {
                          return 0.1 - kRise_mm * std::exp(std::min(0.0, dot(p - Point3{}, out)) / kWidth_mm);
                      }));
    const TissueResult result = scene.find();
    double squares = 0;
    int count = 0;
    scene.forEach(result.tissue, kMargin_mm, [&](Point3 p, double found, double truth) {
        if (std::hypot(p.x, p.y) < 3) {
            squares += (found - truth) * (found - truth);
            ++count;
        }
    });
    EXPECT_LT(std::sqrt(squares / count), 0.05) << GetParam() << " degrees";
}

INSTANTIATE_TEST_SUITE_P(Walls, Risen, testing::Values(60.0, 90.0, 120.0, 135.0));

/// Gas lies flat under a ceiling, and its ends are round, as fluid draws them: what remains of the lumen there is a
/// wedge of fluid that is thinner than the blur.
struct FlatGas {
    double ceiling_mm;  ///< radius of the tube
    double height_mm;   ///< of the gas
    double round_mm;    ///< radius of its ends

    bool isTissue(Point3 p) const { return std::hypot(p.x, p.y - middle_mm()) > ceiling_mm; }
    bool isGas(Point3 p) const { return std::hypot(p.x - nearest(p).x, p.y - nearest(p).y) < round_mm; }
    Point3 end() const
    {
        const double r = ceiling_mm - round_mm, y = middle_mm() - kLevel_mm + round_mm;
        return {std::sqrt(r * r - y * y), kLevel_mm - round_mm, 0};
    }

private:
    double middle_mm() const { return kLevel_mm + ceiling_mm - height_mm; }
    /// Of the places that are the end's radius within the gas.
    Point3 nearest(Point3 p) const
    {
        const double r = ceiling_mm - round_mm, off = std::hypot(p.x, p.y - middle_mm());
        const double top = kLevel_mm - round_mm;
        const Point3 on = off > r ? Point3{p.x * r / off, middle_mm() + (p.y - middle_mm()) * r / off, 0} : p;
        if (on.y <= top)
            return on;
        if (std::hypot(p.x, top - middle_mm()) <= r)
            return {p.x, top, 0};
        return {std::copysign(end().x, p.x), top, 0};
    }
    static constexpr double kLevel_mm = 0.1;
};

class FlatGasUnderACeiling : public testing::TestWithParam<FlatGas> {};

TEST_P(FlatGasUnderACeiling, LeavesNoRidgeAtItsEnds)
{
    const FlatGas gas = GetParam();
    for (const double noise_hu : {0.0, 20.0}) {
        const Scene scene([&](Point3 p) { return gas.isTissue(p); },
                          std::function([&](Point3 p) { return gas.isGas(p) ? 1e3 : -1e3; }), noise_hu);
        const TissueResult result = scene.find();
        double squares = 0;
        int count = 0;
        scene.forEach(result.tissue, kMargin_mm, [&](Point3 p, double found, double truth) {
            if (std::hypot(std::abs(p.x) - gas.end().x, p.y - gas.end().y) < 3 + gas.round_mm) {
                squares += (found - truth) * (found - truth);
                ++count;
            }
        });
        EXPECT_LT(std::sqrt(squares / count), 0.05) << noise_hu << " HU of noise";
    }
}

INSTANTIATE_TEST_SUITE_P(Ends, FlatGasUnderACeiling,
                         testing::Values(FlatGas{20, 5, 2}, FlatGas{20, 5, 1}, FlatGas{20, 3, 1.4}, FlatGas{14, 5, 2},
                                         FlatGas{14, 8, 2}, FlatGas{30, 5, 2.4}));

/// What crosses a level or is half sunk keeps its shape.
TEST(Tissue, FoldsAndBallsAtALevelKeepTheirShape)
{
    const auto fold = [](Point3 p) { return std::abs(p.x - p.y) / std::numbers::sqrt2 < 1.4; };
    const auto ball = [](Point3 p) { return p.x * p.x + p.y * p.y + p.z * p.z < 16; };
    for (const Scene::IsTissue& isTissue : {Scene::IsTissue(fold), Scene::IsTissue(ball)}) {
        const Scene scene(isTissue, 0.1, 20);
        double squares = 0;
        int count = 0;
        scene.forEach(scene.find().tissue, kMargin_mm, [&](Point3 p, double found, double truth) {
            if (std::abs(p.y) < 2.5 && truth > 0.02 && truth < 0.98) {
                squares += (found - truth) * (found - truth);
                ++count;
            }
        });
        EXPECT_LT(std::sqrt(squares / count), 0.06);
    }
}

class Down : public testing::TestWithParam<Vector3> {};

TEST_P(Down, ThereIsNoSurfaceBetweenGasAndFluid)
{
    const Scene scene([](Point3 p) { return std::hypot(p.x, p.y) > 11 || std::abs(p.z) > 13; }, 0.1, 25, 48,
                      normalized(GetParam()));
    const TissueResult result = scene.find(25);
    NoProgress quiet;
    const LumenSurface surface(result.tissue, result.lumen, quiet);
    SegmentVolume segments(scene.grid);
    std::transform(scene.inside.voxels.begin(), scene.inside.voxels.end(), segments.voxels.begin(),
                   [](std::uint8_t label) { return std::uint16_t(label != kOutside); });
    const CellSurface cells = surface.cellsOf(segments, quiet);
    double worst_mm = 0;
    for (std::size_t n = 0; n < cells.pointCount(); ++n) {
        const Point3 p = cells.point(n);
        if (std::abs(p.z) < 9)
            worst_mm = std::max(worst_mm, std::abs(std::hypot(p.x, p.y) - 11));
    }
    EXPECT_LT(worst_mm, 0.8);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < cells.triangleCount(); ++t) {
        EXPECT_EQ(cells.segment[t], 1);
        for (std::size_t n = 0; n < 3; ++n)
            ++edges[{cells.triangles[3 * t + n], cells.triangles[3 * t + (n + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges)
        ASSERT_TRUE(count == 1 && edges.contains({edge.second, edge.first})) << "the surface is not closed";
}

/// Supine, prone, decubitus, upright, and on a tilted table.
INSTANTIATE_TEST_SUITE_P(Lying, Down,
                         testing::Values(kDown, Vector3{0, -1, 0}, Vector3{1, 0, 0}, Vector3{0, 0, 1},
                                         Vector3{0, 0.94, 0.34}));

TEST(Tissue, CleansedDensitiesAreGasWhereFluidWasAndUntouchedElsewhere)
{
    const Scene scene([](Point3 p) { return std::abs(p.x) > 11; });
    const TissueResult result = scene.find();
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (std::abs(p.x) < 8 && p.y > 3) {
            ASSERT_LT(result.cleansed.voxels[n], -900);
        } else if (p.y < -5) {
            ASSERT_EQ(result.cleansed.voxels[n], scene.hu.voxels[n]);
        }
    }
}

}  // namespace
}  // namespace vicon::steps

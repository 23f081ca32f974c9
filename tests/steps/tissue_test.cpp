#include "vicon/steps/tissue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "tissue/smooth_along_wall.h"
#include "vicon/core/error.h"
#include "vicon/steps/cells.h"

namespace vicon::steps {
namespace {

NoProgress quiet;

constexpr double kGasHu = -1000, kTissueHu = 40, kFluidHu = 700, kSigma_mm = 0.7, kVoxel_mm = 0.7;
constexpr Vector3 kDown{0, 1, 0};  // supine; levels lie at y = 0.1

/// A blurred scan of tissue with gas above the level and fluid below it.
struct Scene {
    using IsTissue = std::function<bool(Point3)>;

    explicit Scene(const IsTissue& isTissue, double level_mm = 0.1, double noise_hu = 0, int size = 48,
                   Vector3 down = kDown)
        : grid{.size = {size, size, size}, .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}},
          hu(grid),
          inside(grid),
          truth(grid),
          down(down)
    {
        const double half = (size - 1) * kVoxel_mm / 2;
        grid.origin_mm = {-half, -half, -half};
        hu.grid = inside.grid = truth.grid = grid;
        const std::vector<float> tissue = blurred([&](Point3 p) { return isTissue(p) ? 1.0 : 0.0; });
        const std::vector<float> fluid =
            blurred([&](Point3 p) { return !isTissue(p) && dot(p - Point3{}, down) > level_mm ? 1.0 : 0.0; });
        std::mt19937 random(7);
        std::normal_distribution<double> noise(0, std::max(noise_hu, 1e-9));
        for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
            const double s = tissue[n], f = fluid[n];
            truth.voxels[n] = float(s);
            hu.voxels[n] = std::int16_t(
                std::lround(s * kTissueHu + f * kFluidHu + (1 - s - f) * kGasHu + (noise_hu > 0 ? noise(random) : 0)));
            const double depth_mm = dot(grid.pointAt(grid.indexOf(n)) - Point3{}, down);
            inside.voxels[n] = s >= 0.5 ? kOutside : depth_mm > level_mm ? kFluid : kGas;
        }
    }

    TissueResult find(double noise_hu = 20) const { return findTissue(hu, inside, down, {}, noise_hu, quiet); }

    /// Calls use(place, found fraction, true fraction) for the voxels at least `margin_mm` within the scan.
    template <class Use>
    void forEach(const TissueVolume& tissue, double margin_mm, Use use) const
    {
        const double half = -grid.origin_mm.x - margin_mm;
        for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            if (std::abs(p.x) < half && std::abs(p.y) < half && std::abs(p.z) < half)
                use(p, tissue.voxels[n] / 255.0, double(truth.voxels[n]));
        }
    }

    Grid grid;
    HuVolume hu;
    InsideVolume inside;
    Volume<float> truth;
    Vector3 down;

private:
    /// The Gaussian mean of a function, sampled at half of the voxel's edge.
    std::vector<float> blurred(const std::function<double(Point3)>& f) const
    {
        const int fine = 2 * grid.size[0], reach = int(std::ceil(4 * kSigma_mm / (kVoxel_mm / 2)));
        const auto at = [fine](int i, int j, int k) {
            return std::size_t(i) + std::size_t(fine) * (std::size_t(j) + std::size_t(fine) * std::size_t(k));
        };
        std::vector<float> values(at(0, 0, fine)), kernel;
        for (int k = 0; k < fine; ++k)
            for (int j = 0; j < fine; ++j)
                for (int i = 0; i < fine; ++i)
                    values[at(i, j, k)] = float(f(grid.pointAt(ContinuousIndex3{i / 2.0, j / 2.0, k / 2.0})));
        double sum = 0;
        for (int n = -reach; n <= reach; ++n) {
            kernel.push_back(float(std::exp(-0.5 * std::pow(n * kVoxel_mm / 2 / kSigma_mm, 2))));
            sum += kernel.back();
        }
        for (const std::size_t stride : {at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)}) {
            const std::vector<float> from = values;
            for (std::size_t n = 0; n < values.size(); ++n) {
                const int place = int(n / stride % std::size_t(fine));
                double mean = 0;
                for (int m = -reach; m <= reach; ++m) {
                    const int other = std::clamp(place + m, 0, fine - 1) - place;
                    mean += double(kernel[std::size_t(m + reach)]) *
                            double(from[std::size_t(std::ptrdiff_t(n) + other * std::ptrdiff_t(stride))]);
                }
                values[n] = float(mean / sum);
            }
        }
        std::vector<float> out(grid.voxelCount());
        for (std::size_t n = 0; n < out.size(); ++n) {
            const Index3 v = grid.indexOf(n);
            out[n] = values[at(2 * v.i, 2 * v.j, 2 * v.k)];
        }
        return out;
    }
};

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
    EXPECT_LT(std::sqrt(squares / count), GetParam() < 45 ? 0.11 : 0.09) << GetParam() << " degrees";
    EXPECT_LT(ghost, 0.3) << GetParam() << " degrees";
}

INSTANTIATE_TEST_SUITE_P(Walls, AtLevels, testing::Values(30.0, 45.0, 60.0, 90.0, 120.0, 150.0));

/// A lumen 20 mm wide, with a sheet of tissue across it.
Scene withSheet(double thick_mm, double level_mm, double noise_hu)
{
    return Scene([=](Point3 p) { return std::abs(p.x) < thick_mm / 2 || std::abs(p.x) > 12 || std::abs(p.y) > 12; },
                 level_mm, noise_hu);
}

/// Part of the sheet's middle that is wall.
double shareKept(const Scene& scene, const InsideVolume& lumen)
{
    int kept = 0, all = 0;
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (std::abs(p.x) < kVoxel_mm && std::abs(p.y) < 9 && std::abs(p.z) < 10) {
            // On the two layers of voxels beside the middle: one of them, in each line across, must be wall.
            if (p.x < 0)
                continue;
            Index3 v = scene.grid.indexOf(n);
            const bool here = lumen.at(v) == kOutside;
            --v.i;
            kept += here || lumen.at(v) == kOutside ? 1 : 0;
            ++all;
        }
    }
    return double(kept) / all;
}

/// With the sheet's own label gone where blur left it no half-way density, as a mask by density has it.
InsideVolume labelsByDensity(const Scene& scene, double level_mm)
{
    InsideVolume inside = scene.inside;
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (std::abs(p.x) < 4 && std::abs(p.y) < 11)
            inside.voxels[n] = p.y > level_mm ? (scene.hu.voxels[n] > (kTissueHu + kFluidHu) / 2 ? kFluid : kOutside)
                                              : (scene.hu.voxels[n] < -480 ? kGas : kOutside);
    }
    return inside;
}

struct SheetCase {
    const char* name;
    double thick_mm, level_mm, noise_hu;
};
class Sheets : public testing::TestWithParam<SheetCase> {};

TEST_P(Sheets, StayWholeHoweverMuchBlurTakesFromThem)
{
    const auto [name, thick_mm, level_mm, noise_hu] = GetParam();
    Scene scene = withSheet(thick_mm, level_mm, noise_hu);
    scene.inside = labelsByDensity(scene, level_mm);
    const TissueResult result = scene.find(std::max(noise_hu, 15.0));
    EXPECT_GT(shareKept(scene, result.lumen), 0.99) << name;
}

INSTANTIATE_TEST_SUITE_P(Thin, Sheets,
                         testing::Values(SheetCase{"gas", 1.5, 20, 0}, SheetCase{"gas, thinner than half", 0.8, 20, 0},
                                         SheetCase{"gas, noise", 1, 20, 30}, SheetCase{"fluid", 1.5, -20, 0},
                                         SheetCase{"through the level", 2, 0.1, 0},
                                         SheetCase{"through the level, noise", 2, 0.1, 30}),
                         [](const auto& info) { return std::to_string(info.index); });

class Down : public testing::TestWithParam<Vector3> {};

TEST_P(Down, ThereIsNoSurfaceBetweenGasAndFluid)
{
    const Scene scene([](Point3 p) { return std::hypot(p.x, p.y) > 11 || std::abs(p.z) > 13; }, 0.1, 25, 48,
                      normalized(GetParam()));
    const TissueResult result = scene.find(25);
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

/// How far from a place along a direction the fraction falls to one half, mm.
double toWall_mm(const TissueVolume& tissue, Point3 from, Vector3 direction)
{
    constexpr double kStep_mm = 0.05;
    const auto at = [&](double off_mm) {
        const ContinuousIndex3 p = tissue.grid.continuousIndexAt(from + direction * off_mm);
        double sum = 0;
        for (int n = 0; n < 8; ++n) {
            const Index3 v{int(std::floor(p.i)) + (n & 1), int(std::floor(p.j)) + (n >> 1 & 1),
                           int(std::floor(p.k)) + (n >> 2)};
            sum += (1 - std::abs(p.i - v.i)) * (1 - std::abs(p.j - v.j)) * (1 - std::abs(p.k - v.k)) *
                   tissue.valueOr(v, 255) / 255.0;
        }
        return sum;
    };
    double off_mm = 0;
    while (off_mm < 15 && at(off_mm) >= 0.5)
        off_mm += kStep_mm;
    return off_mm;
}

struct Polyp {
    double width_mm, height_mm, noise_hu;
};

class Polyps : public testing::TestWithParam<Polyp> {};

/// Half an ellipsoid on a flat wall in gas.
TEST_P(Polyps, KeepTheirDiameterAndHeightWhateverTheNoise)
{
    const auto [width_mm, height_mm, noise_hu] = GetParam();
    const double radius_mm = width_mm / 2, wall_mm = -5;
    const auto isTissue = [&](Point3 p) {
        const double up = (p.z - wall_mm) / height_mm;
        return p.z < wall_mm || (p.x * p.x + p.y * p.y) / (radius_mm * radius_mm) + up * up < 1;
    };
    const Scene scene(isTissue, 20, noise_hu);
    TissueVolume blurred(scene.grid);  // without noise and smoothing
    std::transform(scene.truth.voxels.begin(), scene.truth.voxels.end(), blurred.voxels.begin(),
                   [](float s) { return std::uint8_t(std::lround(255 * s)); });
    const TissueVolume found = scene.find(noise_hu).tissue;
    const auto heightIn = [&](const TissueVolume& tissue) { return toWall_mm(tissue, {0, 0, wall_mm - 2}, {0, 0, 1}); };
    const auto diameterIn = [&](const TissueVolume& tissue) {
        constexpr int kDirections = 16;
        double sum = 0;
        for (int n = 0; n < kDirections; ++n) {
            const double turn = 2 * std::numbers::pi * n / kDirections;
            sum += toWall_mm(tissue, {0, 0, wall_mm + height_mm / 2}, {std::cos(turn), std::sin(turn), 0});
        }
        return 2 * sum / kDirections;
    };
    EXPECT_NEAR(diameterIn(found), diameterIn(blurred), 0.3);
    EXPECT_NEAR(heightIn(found), heightIn(blurred), 0.1 * height_mm);
}

INSTANTIATE_TEST_SUITE_P(OnTheWall, Polyps,
                         testing::Values(Polyp{5, 2.5, 10}, Polyp{5, 2.5, 40}, Polyp{5, 2.5, 80}, Polyp{6, 6, 40},
                                         Polyp{8, 2, 40}, Polyp{8, 2, 80}, Polyp{10, 5, 80}));

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

/// Tagged bowel beside the colon, behind a wall of 1 mm; the labels hold it as far as this.
Scene withOtherBowel(double labelled_to_mm)
{
    Scene scene([](Point3 p) {
        const bool colon = p.x > -14 && p.x<2, other = p.x> 3 && p.x < 14 && p.y > 2;
        return !(colon || other) || std::abs(p.y) > 13 || std::abs(p.z) > 13;
    });
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (p.x > labelled_to_mm)
            scene.inside.voxels[n] = kOutside;
        // Where the wall is thinnest the labels go through it.
        if (p.x > 1 && p.x < 4 && p.y > 6 && p.y < 9 && std::abs(p.z) < 2)
            scene.inside.voxels[n] = kFluid;
    }
    return scene;
}

std::size_t labelledBeyond(const InsideVolume& inside, double x_mm)
{
    std::size_t count = 0;
    for (std::size_t n = 0; n < inside.grid.voxelCount(); ++n)
        count += inside.voxels[n] != kOutside && inside.grid.pointAt(inside.grid.indexOf(n)).x > x_mm;
    return count;
}

TEST(Tissue, BowelThatTheLabelsWereCutOffFromIsNoLumen)
{
    const Scene scene = withOtherBowel(8);
    const TissueResult found = scene.find();
    ASSERT_GT(labelledBeyond(scene.inside, 3), 1000U);
    EXPECT_EQ(labelledBeyond(found.lumen, 3), 0U);
    std::size_t lost = 0;
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n)
        lost += scene.truth.voxels[n] < 0.2 && scene.grid.pointAt(scene.grid.indexOf(n)).x < 1 &&
                scene.inside.voxels[n] != kOutside && found.lumen.voxels[n] == kOutside;
    EXPECT_EQ(lost, 0U) << "of the colon";
}

TEST(Tissue, WhatHoldsGasIsNotTakenForOtherBowel)
{
    Scene scene = withOtherBowel(8);
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (p.x > 4 && p.x < 8 && p.y > 3 && p.y < 6 && std::abs(p.z) < 12) {
            scene.inside.voxels[n] = kGas;
            scene.hu.voxels[n] = std::int16_t(kGasHu);
        }
    }
    const TissueResult found = scene.find();
    EXPECT_GT(double(labelledBeyond(found.lumen, 4)), 0.5 * double(labelledBeyond(scene.inside, 4)));
}

TEST(Tissue, ARecessWithAWallOfItsOwnStaysLumen)
{
    const Scene scene = withOtherBowel(20);
    const TissueResult found = scene.find();
    EXPECT_GT(double(labelledBeyond(found.lumen, 3)), 0.95 * double(labelledBeyond(scene.inside, 3)));
}

TEST(Tissue, ASpeckInTheLumenIsNoWallButALumpIs)
{
    for (const auto& [radius_mm, is_wall] : {std::pair{1.7, false}, std::pair{3.2, true}}) {
        Scene scene([r = radius_mm](Point3 p) { return std::abs(p.x) > 12 || distance(p, {}) < r; }, 20);
        for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n)
            if (std::abs(scene.grid.pointAt(scene.grid.indexOf(n)).x) < 8)
                scene.inside.voxels[n] = kGas;
        const InsideVolume lumen = scene.find().lumen;
        const Index3 middle{scene.grid.size[0] / 2, scene.grid.size[1] / 2, scene.grid.size[2] / 2};
        EXPECT_EQ(lumen.at(middle) == kOutside, is_wall) << radius_mm;
    }
}

TEST(Tissue, RidgesWithTissueBetweenThemAreNoSheets)
{
    // As high as a fold of 1.3 mm; what lies between them holds half of that.
    const Scene scene(
        [](Point3 p) {
            const double from = std::abs(p.x) / 2.7;
            return std::abs(p.x) > 14 || (std::abs(p.x) < 8 && std::abs(from - std::round(from)) < 0.25);
        },
        20);
    EXPECT_LT(scene.find().found.at("sheet_voxels"), 100);
}

TEST(Tissue, NoiseOnAWallIsNoSheet)
{
    for (const double noise_hu : {30.0, 60.0}) {
        const Scene scene([](Point3 p) { return std::abs(p.x) > 8; }, 20, noise_hu);
        EXPECT_EQ(scene.find(noise_hu).found.at("sheet_voxels"), 0) << noise_hu;
    }
}

TEST(Tissue, AFoldInSedimentStaysWhole)
{
    // Contrast medium settled to twice the density of what stands over it, with a fold of 2 mm in it.
    Scene scene([](Point3 p) { return std::abs(p.y) > 13 || std::abs(p.z) > 13 || std::abs(p.x) < 1; }, -20);
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const double over_mm = scene.grid.pointAt(scene.grid.indexOf(n)).y - 9;
        if (over_mm > 0)
            scene.hu.voxels[n] = std::int16_t(
                std::lround(scene.hu.voxels[n] + (1 - scene.truth.voxels[n]) * kFluidHu * std::min(1.0, over_mm / 2)));
    }
    const TissueResult found = scene.find();
    for (std::size_t n = 0; n < scene.grid.voxelCount(); ++n) {
        const Point3 p = scene.grid.pointAt(scene.grid.indexOf(n));
        if (std::abs(p.x) < 0.4 && p.y > -10 && p.y < 12 && std::abs(p.z) < 10) {
            EXPECT_GE(found.tissue.voxels[n], 128) << p.y << " " << p.z;
        }
    }
}

TEST(Tissue, OnAnotherGridIsRefused)
{
    const Scene scene([](Point3 p) { return std::abs(p.x) > 5; }, 20, 0, 16);
    TissueVolume other(Grid{.size = {4, 4, 4}});
    EXPECT_THROW(LumenSurface(other, scene.inside, quiet), Error);
}

}  // namespace
}  // namespace vicon::steps

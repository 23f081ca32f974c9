// New colons made of real ones: their masks and the lines drawn in them, warped.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "field_shapes.h"
#include "shape_overlap.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/steps/lumen_plan.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/wall_distance.h"
#include "vicon/support/support.h"

namespace vicon::steps {
namespace {

/// Moves every point of space smoothly, by 8 mm as root of the mean square, and folds nothing.
class Warp {
public:
    explicit Warp(unsigned seed)
    {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> any(-1, 1), wavelength_mm(140, 260);
        const double move_mm = kMove_mm / std::sqrt(double(kWaves) / 2);
        for (Wave& wave : waves_) {
            wave.per_mm = directionOf(random) * (2 * std::numbers::pi / wavelength_mm(random));
            wave.move_mm = directionOf(random) * move_mm;
            wave.phase = std::numbers::pi * any(random);
        }
    }

    Vector3 at(Point3 p) const
    {
        Vector3 sum{};
        for (const Wave& wave : waves_)
            sum = sum + wave.move_mm * std::sin(dot(p - Point3{}, wave.per_mm) + wave.phase);
        return sum;
    }

    /// Where a point of the original lies: q + at(q) = p.
    Point3 movedTo(Point3 p) const
    {
        Point3 q = p;
        for (int n = 0; n < 40; ++n)
            q = p - at(q);
        return q;
    }

private:
    static constexpr int kWaves = 6;
    static constexpr double kMove_mm = 8;
    struct Wave {
        Vector3 per_mm, move_mm;
        double phase = 0;
    };

    static Vector3 directionOf(std::mt19937& random)
    {
        std::normal_distribution<double> normal;
        const double x = normal(random), y = normal(random), z = normal(random);
        return normalized(Vector3{x, y, z});
    }

    std::array<Wave, kWaves> waves_;
};

/// How much of a place is lumen, between voxels.
double lumenAt(const InsideVolume& inside, Point3 place)
{
    const ContinuousIndex3 p = inside.grid.continuousIndexAt(place);
    double sum = 0;
    for (int n = 0; n < 8; ++n) {
        const Index3 v{int(std::floor(p.i)) + (n & 1), int(std::floor(p.j)) + (n >> 1 & 1),
                       int(std::floor(p.k)) + (n >> 2)};
        if (inside.valueOr(v, kOutside) != kOutside)
            sum += (1 - std::abs(p.i - v.i)) * (1 - std::abs(p.j - v.j)) * (1 - std::abs(p.k - v.k));
    }
    return sum;
}

InsideVolume warped(const InsideVolume& inside, const Warp& warp)
{
    constexpr double kAround_mm = 24;
    Grid grid = inside.grid;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int around = int(std::ceil(kAround_mm / grid.spacing_mm[axis]));
        grid.size[axis] += 2 * around;
        grid.origin_mm = grid.origin_mm - grid.axis[axis] * (around * grid.spacing_mm[axis]);
    }
    InsideVolume moved(grid);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Point3 p = grid.pointAt(grid.indexOf(n));
        moved.voxels[n] = lumenAt(inside, p + warp.at(p)) >= 0.5 ? kGas : kOutside;
    }
    return moved;
}

class WarpedShapes : public testing::TestWithParam<std::tuple<const char*, unsigned>> {};

TEST_P(WarpedShapes, AreFollowedFromTheRectumToTheCaecumInOnePiece)
{
    const auto& [name, seed] = GetParam();
    const std::string file = std::string("shapes/") + name;
    VICON_NEEDS_DATA(file + ".mha");
    const Warp warp(seed);
    const InsideVolume inside = warped(scan_files::readVolume<std::uint8_t>(support::sharedData(file + ".mha")), warp);
    std::vector<Point3> points;
    for (const SkeletonPoint& p : pointsOf(evenly(readCentreline(support::sharedData(file + "_centerline.csv")))))
        points.push_back(warp.movedTo(p.position_mm));
    Skeleton given = evenly(Skeleton{{pieceThrough(points, 0)}});
    NoProgress quiet;
    measureRadii(wallDistance(inside, quiet), given);
    const LumenPlan plan = planForMask(inside);
    ASSERT_EQ(plan.pieces.size(), 1U);
    const Skeleton found = findSkeleton(inside, plan, {}, quiet).curve;
    for (const SkeletonPiece& piece : found.pieces)
        EXPECT_FALSE(piece.bridge);
    const Overlap overlap = compare(given, found);
    print(name, "found", overlap, found.length_mm(), given.length_mm());
    EXPECT_GE(overlap.between, 0.95);
    EXPECT_LT(overlap.back_mm, 10) << "the other way round";
    EXPECT_LT(overlap.given_mm, 60);
}

INSTANTIATE_TEST_SUITE_P(Colons, WarpedShapes,
                         testing::Combine(testing::Values("EdinGCA_3D_00060", "EdinGCA_3D_00090", "HuBMAPVHM_3D_00070",
                                                          "ctc_460"),
                                          testing::Range(1U, 21U)));

}  // namespace
}  // namespace vicon::steps

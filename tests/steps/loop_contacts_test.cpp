// Loops of the colon that are joined through a hole in the wall between them: the centreline goes around each of them,
// and a narrow place that is the only way, or a pouch with two mouths, is no such hole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "segment_shapes.h"
#include "skeleton_phantom.h"
#include "vicon/steps/skeleton.h"

namespace vicon::steps {
namespace {

using test::drawMask;
using test::tubeDistance;

using Polyline = std::vector<Point3>;
using Shape = std::function<bool(Point3)>;

/// Limbs side by side along z with 1.5 mm of wall between them, joined in turn by a half circle at either end.
struct Limbs {
    double radius_mm = 6.5;
    double long_mm = 400;
    int count = 2;

    double pitch_mm() const { return 2 * radius_mm + 1.5; }
    double length_mm() const { return count * long_mm + (count - 1) * std::numbers::pi * pitch_mm() / 2; }
    Polyline line() const
    {
        Polyline points;
        for (int limb = 0; limb < count; ++limb) {
            const bool back = limb % 2 != 0;
            const double y = limb * pitch_mm(), to_z = back ? 0 : long_mm, half = pitch_mm() / 2;
            points.push_back({0, y, long_mm - to_z});
            points.push_back({0, y, to_z});
            for (int n = 1; n < 12 && limb + 1 < count; ++n) {
                const double angle = std::numbers::pi * n / 12;
                points.push_back({0, y + half * (1 - std::cos(angle)), to_z + (back ? -half : half) * std::sin(angle)});
            }
        }
        return points;
    }
    /// Distance from the middle of the nearest limb, where there is no bend.
    double fromMiddle(Point3 p) const
    {
        const double limb = std::clamp(std::round(p.y / pitch_mm()), 0.0, double(count - 1));
        return std::hypot(p.x, p.y - limb * pitch_mm());
    }
};

/// A window in the wall between a limb and the next.
struct Window {
    double wide_mm = 5.5;  ///< across the limbs
    double z_mm = 30;
    int limb = 0;
    double longer_mm = 0;  ///< along the limbs than it is wide

    bool holds(const Limbs& limbs, Point3 p) const
    {
        const double from_wall_mm = std::abs(p.y - (limb + 0.5) * limbs.pitch_mm());
        const double along_mm = std::max(0.0, std::abs(p.z - z_mm) - longer_mm / 2);
        return from_wall_mm < limbs.pitch_mm() / 2 && std::hypot(along_mm, p.x) < wide_mm / 2;
    }
};

/// What differs from plain limbs.
struct Loops {
    Limbs limbs;
    std::vector<Window> windows;
    Shape narrowed = [](Point3) { return false; };  ///< wall within the limbs
    Shape pouch = [](Point3) { return false; };     ///< lumen besides
    double pouch_mm = 0;                            ///< how far it goes towards -y
    double voxel_mm = 1;
    bool lying = false;  ///< the limbs lie in a slice, along x

    /// Between where a point is and where it would be if the limbs did not lie.
    Point3 turned(Point3 p) const { return lying ? Point3{p.z, p.y, p.x} : p; }
    InsideVolume draw() const
    {
        const double rim_mm = limbs.radius_mm + 3, ends_mm = limbs.pitch_mm() + rim_mm;
        const auto voxels = [&](double mm) { return int(std::ceil(mm / voxel_mm)); };
        Grid grid;
        grid.size = {voxels(2 * rim_mm), voxels((limbs.count - 1) * limbs.pitch_mm() + 2 * rim_mm + pouch_mm),
                     voxels(limbs.long_mm + 2 * ends_mm)};
        grid.spacing_mm = {voxel_mm, voxel_mm, voxel_mm};
        grid.origin_mm = {-rim_mm, -rim_mm - pouch_mm, -ends_mm};
        if (lying) {
            std::swap(grid.size[0], grid.size[2]);
            std::swap(grid.origin_mm.x, grid.origin_mm.z);
        }
        const Polyline line = limbs.line();
        return drawMask(grid, [&](Point3 at) {
            const Point3 p = turned(at);
            const bool in_window = std::any_of(windows.begin(), windows.end(),
                                               [&](const Window& window) { return window.holds(limbs, p); });
            return in_window || pouch(p) || (tubeDistance(line, limbs.radius_mm, p) < 0 && !narrowed(p));
        });
    }
};

SkeletonResult centrelineOf(const Loops& loops)
{
    const Polyline line = loops.limbs.line();
    const Vector3 to_tip{0, 0, loops.limbs.radius_mm - 2};
    LumenPlan plan;
    plan.pieces.push_back({loops.turned(line.front() - to_tip),
                           loops.turned(loops.limbs.count % 2 == 0 ? line.back() - to_tip : line.back() + to_tip)});
    NoProgress quiet;
    return findSkeleton(loops.draw(), plan, {}, quiet);
}

void expectFollowed(const Loops& loops)
{
    const SkeletonResult found = centrelineOf(loops);
    const Polyline line = loops.limbs.line();
    EXPECT_NEAR(found.curve.length_mm(), loops.limbs.length_mm(), 5);
    double aside_mm = 0;
    for (const SkeletonPiece& piece : found.curve.pieces)
        for (const SkeletonPoint& p : piece.points)
            aside_mm = std::max(aside_mm, tubeDistance(line, 0, loops.turned(p.position_mm)));
    EXPECT_LT(aside_mm, 2);
}

Loops joinedBy(std::vector<Window> windows, Limbs limbs = {})
{
    Loops loops;
    loops.limbs = limbs;
    loops.windows = std::move(windows);
    return loops;
}

struct Hole {
    double radius_mm, wide_mm;
};

class LoopsWithAHole : public testing::TestWithParam<Hole> {};

TEST_P(LoopsWithAHole, AreFollowedAround)
{
    expectFollowed(joinedBy({{.wide_mm = GetParam().wide_mm}}, {.radius_mm = GetParam().radius_mm}));
}

INSTANTIATE_TEST_SUITE_P(Widths, LoopsWithAHole,
                         testing::Values(Hole{6.5, 3}, Hole{6.5, 5}, Hole{6.5, 5.5}, Hole{6.5, 6}, Hole{6.5, 8},
                                         Hole{6.5, 10}, Hole{8, 6}, Hole{8, 10}, Hole{10, 5.5}, Hole{10, 8},
                                         Hole{10, 12}, Hole{15, 8}, Hole{15, 16}, Hole{15, 20}));

TEST(LoopContacts, AreNoWayWhateverVoxelsTheyFallOn)
{
    for (const double z_mm : {30.0, 30.5}) {
        Loops loops = joinedBy({{.wide_mm = 6, .z_mm = z_mm}});
        loops.voxel_mm = 0.75;
        expectFollowed(loops);
    }
}

TEST(LoopContacts, NearABendAreNoWay)
{
    for (const double from_bend_mm : {40.0, 70.0, 100.0})
        for (const double wide_mm : {5.5, 8.0})
            expectFollowed(joinedBy({{.wide_mm = wide_mm, .z_mm = 400 - from_bend_mm}}));
}

TEST(LoopContacts, LeaveNoWallThatPassesForARectalTube)
{
    // The wall between hole and bend has lumen all around it in a slice.
    for (const double from_bend_mm : {50.0, 70.0, 100.0})
        for (const double wide_mm : {5.5, 8.0}) {
            Loops loops = joinedBy({{.wide_mm = wide_mm, .z_mm = 400 - from_bend_mm}});
            loops.lying = true;
            expectFollowed(loops);
        }
}

TEST(LoopContacts, BesideTheEndsAreNoWay)
{
    for (const double wide_mm : {5.5, 8.0})
        expectFollowed(joinedBy({{.wide_mm = wide_mm, .z_mm = 0}}));
}

TEST(LoopContacts, AreNoWayWhereThereAreSeveral)
{
    for (const double wide_mm : {5.5, 8.0}) {
        expectFollowed(joinedBy({{wide_mm, 30}, {wide_mm, 60}}));
        expectFollowed(joinedBy({{wide_mm, 30, 0}, {wide_mm, 370, 1}}, {.count = 3}));
        expectFollowed(joinedBy({{wide_mm, 200, 0}, {wide_mm, 200, 1}}, {.count = 3}));
    }
}

TEST(LoopContacts, AreNoWayWhereTheyAreLong)
{
    expectFollowed(joinedBy({{.wide_mm = 5.5, .z_mm = 40, .longer_mm = 20}}));
    expectFollowed(joinedBy({{.wide_mm = 8, .z_mm = 40, .longer_mm = 10}}));
}

TEST(LoopContacts, AreNoWayWhereFoldsOrASpasmAreNarrower)
{
    Loops folded = joinedBy({{.wide_mm = 8, .z_mm = 40}});
    folded.narrowed = [limbs = folded.limbs](Point3 p) {
        const bool in_fold = std::abs(std::remainder(p.z - 5, 25)) < 1.5 && p.z < 395;
        return in_fold && limbs.fromMiddle(p) > 0.55 * limbs.radius_mm;
    };
    expectFollowed(folded);
    Loops spastic = joinedBy({{.wide_mm = 8}});
    spastic.narrowed = [limbs = spastic.limbs](Point3 p) {
        return std::abs(p.z - 200) < 10 && p.y < limbs.radius_mm && limbs.fromMiddle(p) > 2;
    };
    expectFollowed(spastic);
}

TEST(LoopContacts, AStrictureIsNoneThoughAPouchHangsOnBesideIt)
{
    // 4 mm wide over 20 mm; a blind pouch begins where the colon has its width again.
    Loops loops;
    loops.limbs.count = 1;
    loops.narrowed = [limbs = loops.limbs](Point3 p) { return std::abs(p.z - 200) < 10 && limbs.fromMiddle(p) > 2; };
    loops.pouch_mm = 90;
    loops.pouch = [](Point3 p) { return tubeDistance({{0, 0, 218}, {0, -75, 218}}, 6, p) < 0; };
    expectFollowed(loops);
}

TEST(LoopContacts, APouchWithTwoMouthsBesideAFoldIsNoWay)
{
    // A fold leaves 14 of 30 mm; past it leads a ring 24 mm wide, its mouths 8, 12 or 16 mm.
    for (const double mouth_mm : {4.0, 6.0, 8.0}) {
        Loops loops;
        loops.limbs = {.radius_mm = 15, .count = 1};
        loops.narrowed = [limbs = loops.limbs](Point3 p) { return std::abs(p.z - 200) < 2 && limbs.fromMiddle(p) > 7; };
        Polyline ring;
        for (int n = 0; n <= 24; ++n) {
            const double angle = std::numbers::pi * n / 24;
            ring.push_back({0, -15 - 60 * std::sin(angle), 200 - 40 * std::cos(angle)});
        }
        loops.pouch_mm = 90;
        loops.pouch = [=, wide = Polyline(ring.begin() + 4, ring.end() - 4)](Point3 p) {
            return tubeDistance({{0, 0, 160}, ring[3]}, mouth_mm, p) < 0 ||
                   tubeDistance({{0, 0, 240}, ring[21]}, mouth_mm, p) < 0 ||
                   (p.y < -17 && tubeDistance(wide, 12, p) < 0);
        };
        expectFollowed(loops);
    }
}

TEST(LoopContacts, OfPhantomsThatRunIntoThemselvesAreNoWay)
{
    NoProgress quiet;
    for (const std::uint64_t seed : {21U, 23U}) {
        phantom::PhantomOptions options;
        options.seed = seed;
        options.size = {256, 256, 288};
        options.spacing_mm = {1.5, 1.5, 1.5};
        options.gaps = 0;
        options.self_contact = true;
        const auto truth = phantom::makeScan(options, "HFS", quiet).truth;
        LumenPlan plan;
        plan.pieces.push_back({truth.curve.front().position_mm, truth.curve.back().position_mm});
        const auto errors = test::curveErrors(findSkeleton(truth.inside, plan, {}, quiet).curve, truth);
        EXPECT_LT(std::abs(errors.length_fraction), 0.02) << "seed " << seed;
        EXPECT_LT(errors.most_mm, 2) << "seed " << seed;
    }
}

}  // namespace
}  // namespace vicon::steps

#include "vicon/steps/exit_distance.h"

#include <gtest/gtest.h>
#include <itkFastMarchingImageFilter.h>
#include <itkImage.h>

#include <cmath>

#include "field_shapes.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/support/support.h"

namespace vicon::steps {
namespace {

NoProgress quiet;

float at(const FieldVolume& field, Point3 p)
{
    return field.at(field.grid.indexAt(p));
}

InsideVolume capsule(const Grid& grid, Point3 a, Point3 b, double radius_mm)
{
    const Skeleton axis{{pieceThrough({a, b}, radius_mm)}};
    return maskOf(grid, [&](Point3 p) { return axis.nearest(p).distance_mm < radius_mm; });
}

void add(InsideVolume& to, const InsideVolume& mask)
{
    for (std::size_t n = 0; n < to.voxels.size(); ++n)
        to.voxels[n] |= mask.voxels[n];
}

TEST(ExitDistance, AlongAStraightTubeIsTheWayThroughIt)
{
    // Along an axis and oblique to all of them; isotropic and not.
    struct Case {
        Point3 from, to;
        std::array<double, 3> spacing_mm;
    };
    for (const Case& c : {Case{{10, 10, 8}, {10, 10, 70}, {0.8, 0.8, 0.8}}, Case{{8, 9, 8}, {60, 40, 50}, {1, 1, 1}},
                          Case{{8, 9, 8}, {60, 40, 50}, {0.9, 0.7, 1.2}}}) {
        Grid grid{.size = {80, 70, 90}, .spacing_mm = c.spacing_mm};
        const InsideVolume inside = capsule(grid, c.from, c.to, 6);
        const Skeleton skeleton{{pieceThrough({c.from, c.to}, 6)}};
        const FieldVolume field = exitDistance(inside, skeleton, quiet);
        for (double s = 10; s < skeleton.length_mm(); s += 5)
            EXPECT_NEAR(at(field, skeleton.at(s).position_mm), s, 1.2 + 0.02 * s);
    }
}

TEST(ExitDistance, HugsTheInnerWallOfABend)
{
    // Half a torus: from an end on the axis the shortest way is a tangent to the inner circle, then its arc.
    const double bend_mm = 30, radius_mm = 8, inner_mm = bend_mm - radius_mm;
    Grid grid{.size = {130, 70, 36}, .origin_mm = {-45, -3, -12.6}, .spacing_mm = {0.7, 0.7, 0.7}};
    const InsideVolume inside =
        maskOf(grid, [&](Point3 p) { return p.y >= 0 && std::hypot(std::hypot(p.x, p.y) - bend_mm, p.z) < radius_mm; });
    std::vector<Point3> axis;
    for (int n = 0; n <= 90; ++n)
        axis.push_back({bend_mm * std::cos(M_PI * n / 90), bend_mm * std::sin(M_PI * n / 90), 0});
    const FieldVolume field = exitDistance(inside, {{pieceThrough(axis, radius_mm)}}, quiet);
    const double tangent_mm = std::sqrt(bend_mm * bend_mm - inner_mm * inner_mm), saved = std::acos(inner_mm / bend_mm);
    for (const double angle : {1.6, 2.0, 2.5, 3.0}) {
        const Point3 p{bend_mm * std::cos(angle), bend_mm * std::sin(angle), 0};
        const double expected = 2 * tangent_mm + inner_mm * (angle - 2 * saved);
        // First-order differences are late at a wall of voxels, never early.
        EXPECT_GT(at(field, p), 0.99 * expected - 0.7) << angle;
        EXPECT_LT(at(field, p), 1.05 * expected + 0.7) << angle;
    }
}

TEST(ExitDistance, AgreesWithItksFastMarching)
{
    Grid grid{.size = {60, 50, 40}};
    InsideVolume inside = capsule(grid, {10, 10, 10}, {50, 10, 10}, 7);
    add(inside, capsule(grid, {50, 10, 10}, {45, 40, 28}, 6));
    // A radius of 0 starts at a single voxel, as ITK does.
    Skeleton skeleton{{pieceThrough({{10, 10, 10}, {50, 10, 10}, {45, 40, 28}}, 0)}};
    const FieldVolume field = exitDistance(inside, skeleton, quiet);

    using Image = itk::Image<float, 3>;
    auto speed = Image::New();
    speed->SetRegions(Image::SizeType{60, 50, 40});
    speed->Allocate();
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        speed->GetBufferPointer()[n] = inside.voxels[n] ? 1.0F : 0.0F;
    using March = itk::FastMarchingImageFilter<Image, Image>;
    auto march = March::New();
    auto seeds = March::NodeContainer::New();
    March::NodeType seed;
    seed.SetIndex({10, 10, 10});
    seed.SetValue(0);
    seeds->InsertElement(0, seed);
    march->SetInput(speed);
    march->SetTrialPoints(seeds);
    march->Update();
    for (std::size_t n = 0; n < inside.voxels.size(); ++n) {
        const float expected = inside.voxels[n] ? march->GetOutput()->GetBufferPointer()[n] : -1;
        ASSERT_NEAR(field.voxels[n], expected, 0.02);
    }
}

TEST(ExitDistance, GoesOnOverABridgeByItsLength)
{
    Grid grid{.size = {100, 24, 24}};
    InsideVolume inside = capsule(grid, {10, 12, 12}, {35, 12, 12}, 6);
    add(inside, capsule(grid, {65, 12, 12}, {90, 12, 12}, 6));
    Skeleton skeleton;
    skeleton.pieces.push_back(pieceThrough({{10, 12, 12}, {38, 12, 12}}, 6));
    skeleton.pieces.push_back(pieceThrough({{38, 12, 12}, {50, 22, 12}, {62, 12, 12}}, 1, 28, true));
    skeleton.pieces.push_back(
        pieceThrough({{62, 12, 12}, {90, 12, 12}}, 6, skeleton.pieces.back().points.back().station_mm));
    const FieldVolume field = exitDistance(inside, skeleton, quiet);
    EXPECT_NEAR(at(field, {38, 12, 12}), 28, 0.5);
    const double bridge_mm = 2 * std::hypot(12, 10);
    EXPECT_NEAR(at(field, {62, 12, 12}), 28 + bridge_mm, 0.5);
    EXPECT_NEAR(at(field, {85, 12, 12}), 28 + bridge_mm + 23, 1);
    EXPECT_EQ(at(field, {50, 12, 12}), -1);
}

TEST(ExitDistance, TakesNoShortCutThroughAContact)
{
    // Two long parallel tubes joined at the far end by a bend, touching each other half-way through a hole.
    Grid grid{.size = {170, 50, 22}};
    InsideVolume inside = capsule(grid, {10, 12, 11}, {150, 12, 11}, 8);
    add(inside, capsule(grid, {150, 12, 11}, {150, 34, 11}, 8));
    add(inside, capsule(grid, {150, 34, 11}, {10, 34, 11}, 8));
    add(inside, capsule(grid, {50, 12, 11}, {50, 34, 11}, 3));
    const Skeleton skeleton{{pieceThrough({{10, 12, 11}, {150, 12, 11}, {150, 34, 11}, {10, 34, 11}}, 8)}};
    const FieldVolume field = exitDistance(inside, skeleton, quiet);
    EXPECT_NEAR(at(field, {50, 12, 11}), 40, 1);
    EXPECT_GT(at(field, {50, 34, 11}), 230);
    EXPECT_GT(at(field, {12, 34, 11}), 265);
}

TEST(ExitDistance, IsFiniteOnEveryInsideVoxel)
{
    Grid grid{.size = {60, 30, 30}};
    InsideVolume inside = capsule(grid, {10, 12, 12}, {45, 12, 12}, 6);
    inside.at({0, 12, 12}) = kGas;                             // apart, at the grid's border
    inside.at({50, 20, 20}) = kFluid;                          // apart
    inside.at({51, 21, 21}) = kFluid;                          // joined to it over a corner
    inside.at({52, 12, 12}) = inside.at({53, 13, 12}) = kGas;  // joined over an edge to nothing
    const FieldVolume field = exitDistance(inside, {{pieceThrough({{10, 12, 12}, {45, 12, 12}}, 6)}}, quiet);
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        if (inside.voxels[n]) {
            EXPECT_GE(field.voxels[n], 0);
            EXPECT_LT(field.voxels[n], 80);
        } else {
            EXPECT_EQ(field.voxels[n], -1);
        }
    EXPECT_NEAR(field.at({51, 21, 21}) - field.at({50, 20, 20}), std::sqrt(3.0), 1e-4);
}

TEST(ExitDistance, OfARealColonGrowsAllAlongItsCentreline)
{
    VICON_NEEDS_DATA("shapes/EdinGCA_3D_00090.mha");
    auto inside = scan_files::readVolume<std::uint8_t>(support::sharedData("shapes/EdinGCA_3D_00090.mha"));
    const Skeleton skeleton = readCentreline(support::sharedData("shapes/EdinGCA_3D_00090_centerline.csv"));
    const FieldVolume field = exitDistance(inside, skeleton, quiet);
    float before = 0;
    for (double s = 20; s < skeleton.length_mm(); s += 20) {
        const Index3 v = inside.grid.indexAt(skeleton.at(s).position_mm);
        if (!inside.valueOr(v, kOutside))
            continue;
        EXPECT_GT(field.at(v), before);
        EXPECT_LT(field.at(v), 1.1 * s + 5);
        before = field.at(v);
    }
    EXPECT_GT(before, 0.6 * skeleton.length_mm());
}

TEST(ExitDistance, RefusesAnEmptySkeletonAndAnEmptyMask)
{
    const InsideVolume empty(Grid{.size = {5, 5, 5}});
    EXPECT_THROW(exitDistance(empty, Skeleton{}, quiet), Error);
    EXPECT_THROW(exitDistance(empty, Skeleton{{pieceThrough({{1, 1, 1}, {3, 3, 3}}, 1)}}, quiet), Error);
}

}  // namespace
}  // namespace vicon::steps

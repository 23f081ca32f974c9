// The biopsy by command: of what is circled straight from the lumen, never of the fat behind it.
#include <gtest/gtest.h>

#include <cmath>

#include "case_fixture.h"
#include "density_scenes.h"
#include "vicon/cases/density_sample.h"
#include "vicon/cases/placing.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/volume_file.h"

namespace vicon {
namespace {

using test::Blurred;
using test::FlatWall;
using test::Polyp;

/// A wall at x = 0 with half a ball on it around the origin; the lumen is where x is larger.
CellSurface wallWithHalfBall(double radius_mm)
{
    constexpr int kSide = 81;
    constexpr double kEdge_mm = 0.4, kHalf_mm = kEdge_mm * (kSide / 2);
    CellSurface surface;
    for (int k = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j) {
            const double y = j * kEdge_mm - kHalf_mm, z = k * kEdge_mm - kHalf_mm;
            const double x = std::sqrt(std::max(0.0, radius_mm * radius_mm - y * y - z * z));
            const Vector3 normal = x > 0 ? normalized({x, y, z}) : Vector3{1, 0, 0};
            for (const double c : {x, y, z})
                surface.points_mm.push_back(float(c));
            for (const double c : {normal.x, normal.y, normal.z})
                surface.normals.push_back(float(c));
        }
    for (std::uint32_t k = 0; k + 1 < kSide; ++k)
        for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
            const std::uint32_t n = k * kSide + j;
            surface.triangles.insert(surface.triangles.end(), {n, n + 1, n + kSide, n + 1, n + kSide + 1, n + kSide});
        }
    surface.segment.assign(surface.triangleCount(), 1);
    return surface;
}

TEST(CircledByCommand, ABareWallIsNotRaisedAndAFindingIsAsHighAsItStands)
{
    for (const Point3 at : {Point3{0, 0, 0}, {1.5, 0.3, -0.2}, {-1.5, 0, 0.4}}) {
        const CircledWall bare = circleWall(wallWithHalfBall(0), at, 4);
        EXPECT_NEAR(dot(bare.inwards, {-1, 0, 0}), 1, 1e-3) << at.x;
        EXPECT_NEAR(bare.surface_mm.x, 0, 0.1) << at.x;
        EXPECT_NEAR(bare.raised_mm, 0, 0.1) << at.x;
    }
    for (const double radius_mm : {3.0, 5.0, 7.0})
        for (const double height : {0.0, 0.5, 1.0}) {
            const CircledWall raised = circleWall(wallWithHalfBall(radius_mm), {height * radius_mm, 0, 0}, radius_mm);
            EXPECT_NEAR(dot(raised.inwards, {-1, 0, 0}), 1, 0.02) << radius_mm << ", " << height;
            EXPECT_NEAR(raised.surface_mm.x, radius_mm, 0.3) << radius_mm << ", " << height;
            EXPECT_NEAR(raised.raised_mm, radius_mm, 1) << radius_mm << ", " << height;
        }
}

TEST(CircledByCommand, WithoutAWallThereIsNothingToCircle)
{
    EXPECT_THROW(circleWall(wallWithHalfBall(0), {9, 0, 0}, 4), Error);
}

class BiopsyByCommand : public testing::Test {
protected:
    Marker taken(const Blurred& scene, double half_ball_mm, Point3 at, double radius_mm)
    {
        const std::filesystem::path folder = one_.scanFolder();
        scan_files::writeVolume(folder / "volume.mha", scene.volume, scan_files::Packing::raw);
        scan_files::writeVolume(folder / "inside.mha", scene.inside, scan_files::Packing::raw);
        scan_files::writeCells(folder / "cells.vtp", wallWithHalfBall(half_ball_mm));
        Marker marker{.scan_id = "s1", .position_mm = at};
        addDensity(one_.store, "c1", marker, radius_mm);
        return marker;
    }

    test::StoreOfOneScan one_;
};

TEST_F(BiopsyByCommand, NeverCountsTheFatBehindABareWall)
{
    for (const Point3 at : {Point3{0, 0, 0}, {-1, 0, 0}, {-2, 0, 0}}) {
        SCOPED_TRACE(at.x);
        try {
            taken(FlatWall(1.6, 0.74, 0.65), 0, at, 5);
            ADD_FAILURE() << "a wall too thin to be measured";
        } catch (const Error& refused) {
            EXPECT_EQ(refused.code(), ErrorCode::wrong_use);
            EXPECT_NE(std::string(refused.what()).find("too little tissue between its surface and its far side"),
                      std::string::npos)
                << refused.what();
        }
        const Marker thick = taken(FlatWall(6, 0.74, 0.65), 0, at, 5);
        EXPECT_NEAR(thick.density->mean_hu, 40, 15);
        EXPECT_LT(thick.density->fat_fraction, 0.05);
    }
}

TEST_F(BiopsyByCommand, OfWhatStandsOnTheWallIsItsOwnDensityEvenThatOfFat)
{
    for (const double diameter_mm : {8.0, 10.0, 14.0})
        for (const double tissue_hu : {40.0, -100.0}) {
            const double radius_mm = diameter_mm / 2;
            const Marker marker =
                taken(Polyp(diameter_mm, tissue_hu, 0.74, 0.65), radius_mm, {radius_mm / 2, 0, 0}, radius_mm);
            EXPECT_NEAR(marker.density->mean_hu, tissue_hu, 12) << diameter_mm;
        }
}

}  // namespace
}  // namespace vicon

// The stomach, a cavity that no path leads through: lumen, segments and files, against a phantom.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "organ_checks.h"
#include "vicon/core/error.h"
#include "vicon/phantom/organ_phantom.h"
#include "vicon/pipeline/organs.h"
#include "vicon/pipeline/scan_work.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/subdivide.h"
#include "vicon/support/support.h"

namespace vicon::steps {
namespace {

using testing::HasSubstr;

OrganOptions stomach()
{
    Config config;
    config.declare(pipeline::stepOptionSpecs());
    return pipeline::withOrgan(config, Organ("stomach")).get<OrganOptions>();
}

/// A body of tissue with balls of gas.
HuVolume bodyWith(const std::vector<std::pair<Point3, double>>& balls)
{
    HuVolume scan(Grid{.size = {120, 90, 80}, .origin_mm = {-150, -112, -100}, .spacing_mm = {2.5, 2.5, 2.5}}, -1000);
    for (std::size_t n = 0; n < scan.voxels.size(); ++n) {
        const Point3 p = scan.grid.pointAt(scan.grid.indexOf(n));
        if (std::hypot(p.x / 135, p.y / 100) < 1)
            scan.voxels[n] = 30;
        for (const auto& [middle, radius_mm] : balls)
            if (distance(p, middle) < radius_mm)
                scan.voxels[n] = -1000;
    }
    return scan;
}

TEST(Stomach, IsFoundWithItsFoldsAndWithoutGulletBulbAndColon)
{
    NoProgress quiet;
    for (const std::uint64_t seed : {31U, 32U}) {
        phantom::OrganScan scan = phantom::makeOrganScan(
            {.organ = phantom::PhantomOrgan::stomach, .seed = seed, .size = {160, 160, 150}}, quiet);
        const Segmentation found = segmentOrgan(resample(std::move(scan.hu), {}, quiet), stomach(), quiet);
        EXPECT_EQ(found.verdict, Verdict::found) << found.reason;
        EXPECT_GE(test::dice(scan.truth.inside, found.inside), 0.97);
        EXPECT_EQ(undivided(found.inside, {}, quiet).description.segments.size(), 1U) << "it hangs together";
        std::size_t far_off = 0, inside = 0;  // more than two voxels from the true lumen
        for (std::size_t n = 0; n < found.inside.voxels.size(); ++n) {
            if (!found.inside.voxels[n])
                continue;
            ++inside;
            const Index3 v = scan.truth.inside.grid.indexAt(found.inside.grid.pointAt(found.inside.grid.indexOf(n)));
            bool near = false;
            for (int k = -2; k <= 2; ++k)
                for (int j = -2; j <= 2; ++j)
                    for (int i = -2; i <= 2; ++i)
                        near = near || scan.truth.inside.valueOr({v.i + i, v.j + j, v.k + k}, kOutside) != kOutside;
            far_off += !near;
        }
        EXPECT_LE(double(far_off), 0.005 * double(inside)) << "gullet, bulb or colon came with it";
        ASSERT_EQ(found.plan.pieces.size(), 1U);
        EXPECT_EQ(distance(found.plan.pieces[0].rectal_end_mm, found.plan.pieces[0].caecal_end_mm), 0);
        EXPECT_EQ(found.plan.pieces[0].length_mm, 0) << "there is no way through it";
        EXPECT_NEAR(found.plan.pieces[0].max_radius_mm, 31, 6);
    }
}

TEST(Cavity, OfTwoAlikeTheSeedTellsWhichIsMeant)
{
    NoProgress quiet;
    const Point3 left{35, -10, 0}, right{-35, -10, 0};
    const HuVolume scan = bodyWith({{left, 30}, {right, 29}});
    const Segmentation doubtful = segmentOrgan(scan, stomach(), quiet);
    EXPECT_EQ(doubtful.verdict, Verdict::unsure);
    EXPECT_THAT(doubtful.reason, HasSubstr("organ.seed"));
    OrganOptions told = stomach();
    told.seed = {right};
    const Segmentation found = segmentOrgan(scan, told, quiet);
    EXPECT_EQ(found.verdict, Verdict::found) << found.reason;
    EXPECT_NE(found.inside.valueOr(found.inside.grid.indexAt(right), kOutside), kOutside);
    EXPECT_EQ(found.inside.valueOr(found.inside.grid.indexAt(left), kOutside), kOutside);
}

TEST(Cavity, WhatIsTooNarrowOrTooFarAsideIsNone)
{
    NoProgress quiet;
    const Segmentation none = segmentOrgan(bodyWith({{{20, 0, 0}, 10}, {{100, 0, 0}, 25}}), stomach(), quiet);
    EXPECT_EQ(none.verdict, Verdict::absent);
    EXPECT_THAT(none.reason, HasSubstr("no cavity of 15 to 80 mm radius"));
}

TEST(Cavity, IsOneSegmentAndWhatHangsOnIsOneOfItsOwn)
{
    NoProgress quiet;
    InsideVolume inside(Grid{.size = {30, 20, 20}, .spacing_mm = {1, 1, 1}});
    for (int k = 2; k < 18; ++k)
        for (int j = 2; j < 18; ++j)
            for (int i = 2; i < 16; ++i)
                inside.at({i, j, k}) = kGas;
    inside.at({25, 10, 10}) = kGas;
    const Subdivided divided = undivided(inside, {}, quiet);
    ASSERT_EQ(divided.description.segments.size(), 2U);
    EXPECT_FALSE(divided.description.method);
    EXPECT_TRUE(divided.description.portals.empty());
    EXPECT_EQ(divided.segments.at({25, 10, 10}) + divided.segments.at({5, 5, 5}), 3);
    for (std::size_t n = 0; n < inside.voxels.size(); ++n)
        ASSERT_EQ(inside.voxels[n] != kOutside, divided.segments.voxels[n] != 0);
    EXPECT_THROW(undivided(InsideVolume(inside.grid), {}, quiet), Error);
}

TEST(Cavity, ItsFilesSayThatThereIsNoPath)
{
    const support::TemporaryFolder folder;
    scan_files::writeNoPath(folder / "skeleton.vtp", {{1, 2, 3}, 0, 31});
    EXPECT_TRUE(scan_files::readSkeleton(folder / "skeleton.vtp").empty());
    EXPECT_TRUE(scan_files::readSkeletonTree(folder / "skeleton.vtp").empty());
    scan_files::writeSkeletonVoxels(folder / "voxels.vtp", {{{1, 2, 3}, {2, 2, 3}}});
    EXPECT_THROW(scan_files::readSkeleton(folder / "voxels.vtp"), Error) << "not one that says so";
}

}  // namespace
}  // namespace vicon::steps

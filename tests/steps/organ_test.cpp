// Airway and aorta: lumen, tree, stations, sides, against phantoms whose axes are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "organ_checks.h"
#include "vicon/core/error.h"
#include "vicon/phantom/organ_phantom.h"
#include "vicon/pipeline/organs.h"
#include "vicon/pipeline/scan_work.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/steps/exit_distance.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/subdivide.h"
#include "vicon/support/support.h"

namespace vicon::steps {
namespace {

using testing::HasSubstr;

Config configOf(const std::string& organ)
{
    Config config;
    config.declare(pipeline::stepOptionSpecs());
    return pipeline::withOrgan(config, Organ(organ));
}

/// A scan and all that the steps make of it.
struct Worked {
    phantom::OrganTruth truth;
    Segmentation found;
    TreeResult skeleton;
};

Worked work(phantom::PhantomOrgan organ, std::uint64_t seed)
{
    NoProgress quiet;
    const Config config = configOf(nameIn(phantom::kPhantomOrganNames, organ));
    const auto options = config.get<OrganOptions>();
    phantom::OrganScan scan = phantom::makeOrganScan({.organ = organ, .seed = seed, .size = {160, 160, 160}}, quiet);
    Worked out{std::move(scan.truth), segmentOrgan(resample(std::move(scan.hu), {}, quiet), options, quiet), {}};
    if (!out.found.inside.voxels.empty())
        out.skeleton = findTree(out.found.inside, out.found.plan.pieces.at(0).rectal_end_mm, options.branch_mm,
                                config.get<SkeletonOptions>(), quiet);
    return out;
}

/// Shared by the tests: each takes seconds.
const Worked& airway()
{
    static const Worked kWorked = work(phantom::PhantomOrgan::airway, 11);
    return kWorked;
}
const Worked& aorta()
{
    static const Worked kWorked = work(phantom::PhantomOrgan::aorta, 12);
    return kWorked;
}

void expectSoundTree(const Worked& worked)
{
    const SkeletonTree& tree = worked.skeleton.tree;
    ASSERT_EQ(tree.branches.size(), worked.skeleton.voxels.size());
    std::set<std::array<double, 3>> seen;
    for (std::size_t n = 0; n < tree.branches.size(); ++n) {
        const SkeletonBranch& branch = tree.branches[n];
        const auto& voxels = worked.skeleton.voxels[n];
        ASSERT_LT(branch.parent, int(n)) << "a parent comes before its children";
        EXPECT_EQ(branch.parent < 0, n == 0);
        if (branch.parent >= 0) {
            const SkeletonBranch& parent = tree.branches[std::size_t(branch.parent)];
            EXPECT_EQ(branch.generation, parent.generation + 1);
            EXPECT_NEAR(branch.points.front().station_mm, parent.points.back().station_mm, 1e-9);
            EXPECT_LT(distance(branch.points.front().position_mm, parent.points.back().position_mm), 1e-9);
            EXPECT_EQ(distance(voxels.front(), worked.skeleton.voxels[std::size_t(branch.parent)].back()), 0);
        }
        for (std::size_t p = 1; p < branch.points.size(); ++p)
            EXPECT_GE(branch.points[p].station_mm, branch.points[p - 1].station_mm);
        const Grid& grid = worked.found.inside.grid;
        for (std::size_t v = 0; v < voxels.size(); ++v) {
            const Index3 at = grid.indexAt(voxels[v]);
            EXPECT_NE(worked.found.inside.valueOr(at, kOutside), kOutside);
            if (v == 0)
                continue;
            const Index3 before = grid.indexAt(voxels[v - 1]);
            EXPECT_LE(std::max({std::abs(at.i - before.i), std::abs(at.j - before.j), std::abs(at.k - before.k)}), 1);
        }
        EXPECT_TRUE(seen.insert({voxels.back().x, voxels.back().y, voxels.back().z}).second)
            << "two branches end in one voxel: a loop";
        for (const SkeletonPoint& p : branch.points)
            EXPECT_NE(worked.found.inside.valueOr(grid.indexAt(p.position_mm), kOutside), kOutside);
    }
}

TEST(Airway, IsFoundDownToBronchiOfTwoVoxels)
{
    EXPECT_EQ(airway().found.verdict, Verdict::found) << airway().found.reason;
    EXPECT_GE(test::dice(airway().truth.inside, airway().found.inside), 0.88);
    const auto thick = test::compare(test::generations(airway().truth.tree, 0, 3), airway().skeleton.tree);
    EXPECT_EQ(thick.found, thick.branches);
    const auto all = test::compare(airway().truth.tree, airway().skeleton.tree);
    EXPECT_EQ(all.extra, 0) << "no leak into the lung, no spurs";
    EXPECT_LE(all.mean_mm, 0.7);
    EXPECT_LE(all.worst_percentile_mm, 1.6);
}

TEST(Airway, IsATreeWithoutLoopsThatBeginsAtTheTopOfTheTrachea)
{
    expectSoundTree(airway());
    const auto& trachea = airway().skeleton.tree.branches.at(0);
    EXPECT_GT(trachea.points.front().position_mm.z, 110);
    EXPECT_NEAR(trachea.points.back().position_mm.z, 30, 6) << "the carina";
}

TEST(Airway, TheLeftMainBronchusIsTheLongerOneAndLiesOnThePatientsLeft)
{
    double left_mm = 0, right_mm = 0;
    for (const SkeletonBranch& branch : airway().skeleton.tree.branches)
        if (branch.generation == 1) {
            const double length_mm = branch.points.back().station_mm - branch.points.front().station_mm;
            (branch.points.back().position_mm.x > 0 ? left_mm : right_mm) = length_mm;
        }
    EXPECT_GT(left_mm, 35);
    EXPECT_GT(right_mm, 15);
    EXPECT_GT(left_mm, right_mm + 8);
}

TEST(Aorta, IsFoundWithItsBranchesAndWithoutTheSpine)
{
    EXPECT_EQ(aorta().found.verdict, Verdict::found) << aorta().found.reason;
    EXPECT_GE(test::dice(aorta().truth.inside, aorta().found.inside), 0.96);
    const auto all = test::compare(aorta().truth.tree, aorta().skeleton.tree);
    EXPECT_EQ(all.found, all.branches);
    EXPECT_EQ(all.extra, 0);
    EXPECT_LE(all.mean_mm, 0.7);
    EXPECT_LE(all.worst_percentile_mm, 2.0);
    EXPECT_EQ(aorta().skeleton.tree.tips().size(), aorta().truth.tree.tips().size());
}

TEST(Aorta, BeginsAtTheHeartAndEndsInTheIliacArteries)
{
    expectSoundTree(aorta());
    const SkeletonTree& tree = aorta().skeleton.tree;
    const Point3 heart = aorta().truth.tree.branches[0].points[0].position_mm;
    EXPECT_LT(distance(tree.branches[0].points[0].position_mm, heart), 18);
    const Skeleton way = tree.pathTo(tree.tips().front());
    EXPECT_LT(way.at(way.length_mm()).position_mm.z, -150);
}

TEST(Organ, SegmentsLieInOneBranchEachAndTheExitDistanceIsTheWayToTheRoot)
{
    NoProgress quiet;
    const Worked& worked = airway();
    const SkeletonTree& tree = worked.skeleton.tree;
    const Subdivided divided = subdivide(worked.found.inside, tree.allBranches(), worked.skeleton.voxels, {}, quiet);
    ASSERT_GE(divided.description.segments.size(), tree.branches.size());
    for (std::size_t n = 0; n < worked.found.inside.voxels.size(); ++n)
        ASSERT_EQ(worked.found.inside.voxels[n] != kOutside, divided.segments.voxels[n] != 0);
    std::map<int, int> branch_of;
    int shared = 0, asked = 0;
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        const auto& voxels = worked.skeleton.voxels[b];
        for (std::size_t v = 1; v < voxels.size(); ++v) {
            const int segment = divided.segments.at(divided.segments.grid.indexAt(voxels[v]));
            const auto [at, first] = branch_of.insert({segment, int(b)});
            ++asked;
            shared += !first && at->second != int(b);
        }
    }
    EXPECT_LE(shared, asked / 50) << "a segment holds the middle of two branches";
    const FieldVolume exit_mm = exitDistance(worked.found.inside, tree, quiet);
    for (std::size_t n = 0; n < exit_mm.voxels.size(); ++n)
        ASSERT_EQ(exit_mm.voxels[n] >= 0, worked.found.inside.voxels[n] != kOutside);
    for (const int tip : tree.tips()) {
        const SkeletonPoint end = tree.branches[std::size_t(tip)].points.back();
        const double way_mm = double(exit_mm.at(exit_mm.grid.indexAt(end.position_mm)));
        EXPECT_NEAR(way_mm, end.station_mm, 12 + 0.06 * end.station_mm);
    }
}

TEST(Organ, ATreeIsReadBackAsItWasWrittenAndAsOneWayToTheFarthestTip)
{
    const support::TemporaryFolder folder;
    const SkeletonTree& tree = airway().skeleton.tree;
    scan_files::writeSkeletonTree(folder / "skeleton.vtp", tree);
    const SkeletonTree back = scan_files::readSkeletonTree(folder / "skeleton.vtp");
    ASSERT_EQ(back.branches.size(), tree.branches.size());
    for (std::size_t n = 0; n < tree.branches.size(); ++n) {
        EXPECT_EQ(back.branches[n].parent, tree.branches[n].parent);
        EXPECT_EQ(back.branches[n].generation, tree.branches[n].generation);
        EXPECT_EQ(back.branches[n].points.size(), tree.branches[n].points.size());
    }
    const Skeleton way = scan_files::readSkeleton(folder / "skeleton.vtp");
    ASSERT_EQ(way.pieces.size(), 1U);
    double farthest_mm = 0;
    for (const SkeletonBranch& branch : tree.branches)
        farthest_mm = std::max(farthest_mm, branch.points.back().station_mm);
    EXPECT_NEAR(way.length_mm(), farthest_mm, 1e-9);
    EXPECT_THROW((void)tree.pathTo(int(tree.branches.size())), Error);
}

TEST(Organ, WhatIsNotThereIsNotFound)
{
    NoProgress quiet;
    struct Case {
        const char* organ;
        phantom::PhantomOrgan shown;
    };
    for (const Case& c : {Case{"aorta", phantom::PhantomOrgan::airway}, Case{"airway", phantom::PhantomOrgan::aorta}}) {
        phantom::OrganScan scan = phantom::makeOrganScan({.organ = c.shown, .seed = 13, .size = {96, 96, 96}}, quiet);
        const Segmentation found =
            segmentOrgan(resample(std::move(scan.hu), {}, quiet), configOf(c.organ).get<OrganOptions>(), quiet);
        EXPECT_TRUE(found.verdict != Verdict::found) << c.organ << ": " << found.reason;
        EXPECT_FALSE(found.reason.empty());
    }
    const HuVolume air(Grid{.size = {40, 40, 40}, .spacing_mm = {2, 2, 2}}, -1000);
    EXPECT_EQ(segmentOrgan(air, configOf("airway").get<OrganOptions>(), quiet).verdict, Verdict::absent);
}

TEST(Organ, PresetsAreKnownByNameAndYieldToWhatAPersonSets)
{
    EXPECT_THAT(pipeline::organNames(), testing::UnorderedElementsAre("airway", "aorta", "colon", "stomach"));
    Config config;
    config.declare(pipeline::stepOptionSpecs());
    config.set("organ.branch_mm=21");
    EXPECT_EQ(pipeline::withOrgan(config, Organ("aorta")).get<OrganOptions>().branch_mm, 21);
    EXPECT_EQ(pipeline::withOrgan(config, Organ("aorta")).get<OrganOptions>().low_hu, 180);
    EXPECT_EQ(pipeline::withOrgan(config, Organ("aorta")).get<WallDensities>().wall_hu, 170);
    EXPECT_TRUE(pipeline::withOrgan(config, std::nullopt).get<OrganOptions>().isColon());
    try {
        (void)pipeline::withOrgan(config, Organ("spleen"));
        FAIL() << "there is no such preset";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::wrong_use);
        EXPECT_THAT(e.what(), HasSubstr("airway, aorta, colon, stomach"));
    }
}

}  // namespace
}  // namespace vicon::steps

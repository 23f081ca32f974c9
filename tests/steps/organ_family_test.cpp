// Airways, aortas and stomachs of phantoms whose seeds nothing was chosen on; prints what it measures.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "organ_checks.h"
#include "vicon/phantom/organ_phantom.h"
#include "vicon/pipeline/organs.h"
#include "vicon/pipeline/scan_work.h"
#include "vicon/steps/organ.h"
#include "vicon/steps/resample.h"

namespace vicon::steps {
namespace {

using phantom::PhantomOrgan;

struct Limits {
    PhantomOrgan organ;
    double least_dice;
    bool has_tree;
    int to_generation;  ///< to which every branch is found; thinner bronchi, under two voxels, may be missed
};

constexpr Limits kLimits[] = {{PhantomOrgan::airway, 0.88, true, 3},
                              {PhantomOrgan::aorta, 0.96, true, 99},
                              {PhantomOrgan::stomach, 0.97, false, 0}};

void expectTree(const OrganOptions& options, const Config& config, const Segmentation& found, const SkeletonTree& truth,
                int to_generation)
{
    NoProgress quiet;
    const TreeResult skeleton = findTree(found.inside, found.plan.pieces.at(0).rectal_end_mm, options.branch_mm,
                                         config.get<SkeletonOptions>(), quiet);
    const auto all = test::compare(truth, skeleton.tree);
    std::printf(", %d of %d branches, %d extra, axes %.2f mm, 95 %% %.2f mm", all.found, all.branches, all.extra,
                all.mean_mm, all.worst_percentile_mm);
    const auto thick = test::compare(test::generations(truth, 0, to_generation), skeleton.tree);
    EXPECT_EQ(thick.found, thick.branches);
    EXPECT_EQ(all.extra, 0);
    EXPECT_LE(all.mean_mm, 0.7);
    EXPECT_LE(all.worst_percentile_mm, 2);
}

class OrganFamily : public testing::TestWithParam<unsigned> {};

TEST_P(OrganFamily, IsFoundWithItsBranches)
{
    NoProgress quiet;
    for (const Limits& limits : kLimits) {
        const std::string name = nameIn(phantom::kPhantomOrganNames, limits.organ);
        SCOPED_TRACE(name);
        Config config;
        config.declare(pipeline::stepOptionSpecs());
        config = pipeline::withOrgan(config, Organ(name));
        const auto options = config.get<OrganOptions>();
        phantom::OrganScan scan =
            phantom::makeOrganScan({.organ = limits.organ, .seed = GetParam(), .size = {160, 160, 160}}, quiet);
        const Segmentation found = segmentOrgan(resample(std::move(scan.hu), {}, quiet), options, quiet);
        EXPECT_EQ(found.verdict, Verdict::found) << found.reason;
        if (found.inside.voxels.empty())
            continue;
        const double dice = test::dice(scan.truth.inside, found.inside);
        std::printf("seed %u, %s: Dice %.3f", GetParam(), name.c_str(), dice);
        EXPECT_GE(dice, limits.least_dice);
        if (limits.has_tree)
            expectTree(options, config, found, scan.truth.tree, limits.to_generation);
        std::printf("\n");
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OrganFamily, testing::Range(2001U, 2011U), testing::PrintToStringParamName());

}  // namespace
}  // namespace vicon::steps

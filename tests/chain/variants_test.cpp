// One step of scanner, protocol or patient away from the default phantom, on seeds that nothing was chosen on: each
// variant prints what it measures.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>
#include <string>

#include "curve_errors.h"
#include "lumen_errors.h"
#include "vicon/phantom/phantom.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/tissue.h"

namespace vicon::test {
namespace {

using phantom::PhantomOptions;

struct Variant {
    const char* name;
    std::function<void(PhantomOptions&)> set;
    double surface_95_mm;  ///< at most
    std::array<std::uint64_t, 2> seeds = {401, 402};
};

const std::vector<Variant>& variants()
{
    static const std::vector<Variant> all{
        {"usual", [](PhantomOptions&) {}, 0.4},
        {"kernel smooth", [](PhantomOptions& o) { o.protocol.kernel = phantom::Kernel::smooth; }, 0.4},
        {"kernel sharp", [](PhantomOptions& o) { o.protocol.kernel = phantom::Kernel::sharp; }, 0.4, {403, 404}},
        {"slices 0.6 mm", [](PhantomOptions& o) { o.protocol.thickness_mm = 0.6; }, 0.4},
        {"slices 2 mm", [](PhantomOptions& o) { o.protocol.thickness_mm = 2; }, 0.4},
        {"slices 3 mm", [](PhantomOptions& o) { o.protocol.thickness_mm = 3; }, 0.5},
        {"tagging 200 HU", [](PhantomOptions& o) { o.protocol.tagging_hu = 200; }, 0.4},
        {"tagging 1200 HU", [](PhantomOptions& o) { o.protocol.tagging_hu = 1200; }, 0.4},
        {"noise 10 HU", [](PhantomOptions& o) { o.noise_hu = 10; }, 0.4},
        {"noise 80 HU", [](PhantomOptions& o) { o.noise_hu = 80; }, 0.4},
        {"bubbles", [](PhantomOptions& o) { o.protocol.bubbles = 60; }, 0.4},
        {"films", [](PhantomOptions& o) { o.film = true; }, 0.4},
        {"contrast medium", [](PhantomOptions& o) { o.protocol.contrast = true; }, 0.4},
        {"hips, streaks", [](PhantomOptions& o) { o.protocol.hips = phantom::Hips::streaks; }, 0.4},
        {"hips, metal", [](PhantomOptions& o) { o.protocol.hips = phantom::Hips::metal; }, 0.4},
        {"thin walls", [](PhantomOptions& o) { o.thin_walls = true; }, 0.4, {401, 403}},  // 402 has no such colon
    };
    return all;
}

void measure(const Variant& variant, std::uint64_t seed)
{
    NoProgress quiet;
    PhantomOptions options{.seed = seed, .gaps = 1, .extras = false};
    variant.set(options);
    phantom::PhantomScan scan = phantom::makeScan(options, seed % 2 ? "HFS" : "HFP", quiet);
    const HuVolume volume = steps::resample(std::move(scan.hu), {}, quiet);
    const steps::Segmentation found = steps::segmentColon(volume, scan.truth.gravity, {}, quiet);
    ASSERT_FALSE(found.inside.voxels.empty()) << found.reason;
    const steps::TissueResult tissue = steps::findTissue(volume, found.inside, scan.truth.gravity, {},
                                                         found.measures.at("noise_hu").get<double>(), quiet);
    const Skeleton curve = steps::findSkeleton(tissue.lumen, found.plan, {}, quiet).curve;
    const LumenErrors lumen = lumenErrors(volume, tissue.lumen, scan.truth.inside);
    const CurveErrors errors = curveErrors(curve, scan.truth);
    const bool ordered = piecesInOrder(curve, scan.truth);
    std::printf(
        "%-16s seed %d: Dice %.4f, outside %.2f, missed %.2f ml, surface 95 %% %.2f mm; centreline mean %.2f, "
        "95 %% %.2f mm, length %+.2f %%, pieces %s, direction %s; %zu faint walls; %s\n",
        variant.name, int(seed), lumen.dice, lumen.far_outside_ml, lumen.far_missed_ml, lumen.surface_95_mm,
        errors.mean_mm, errors.p95_mm, 100 * errors.length_fraction, ordered ? "right" : "WRONG",
        errors.directed ? "right" : "WRONG", tissue.untrusted.faint.size(), found.reason.c_str());
    std::fflush(stdout);
    EXPECT_EQ(found.verdict, Verdict::found);
    EXPECT_TRUE(ordered);
    EXPECT_TRUE(errors.directed);
    EXPECT_GE(lumen.dice, 0.985);
    EXPECT_LE(lumen.far_outside_ml, 0.2);
    EXPECT_LE(lumen.far_missed_ml, 1.2);
    EXPECT_LE(lumen.surface_95_mm, variant.surface_95_mm);
    EXPECT_LE(errors.mean_mm, 0.4);
    EXPECT_LE(std::abs(errors.length_fraction), 0.01);
}

class Variants : public testing::TestWithParam<std::size_t> {};

TEST_P(Variants, OfScannerAndPatientAreFollowedToo)
{
    for (const std::uint64_t seed : variants()[GetParam()].seeds)
        measure(variants()[GetParam()], seed);
}

INSTANTIATE_TEST_SUITE_P(All, Variants, testing::Range(std::size_t(0), variants().size()),
                         [](const testing::TestParamInfo<std::size_t>& info) {
                             std::string name = variants()[info.param].name;
                             std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                             return name;
                         });

}  // namespace
}  // namespace vicon::test

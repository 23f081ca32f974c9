// The lumen in MR: shading, levels and polarity, on phantoms with a known lumen.
#include "vicon/steps/lumen_contrast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vicon/core/error.h"
#include "vicon/core/quantity.h"
#include "vicon/phantom/phantom.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {
namespace {

// As the phantom makes them, before its shading.
constexpr double kDarkLumen = 40, kBrightLumen = 900, kTissue = 420;

phantom::PhantomScan mrScan(phantom::MrLumen contrast, std::uint64_t seed)
{
    phantom::PhantomOptions options;
    options.seed = seed;
    options.mr = contrast;
    options.size = {176, 176, 144};
    options.folds = false;
    options.catheter = false;
    options.gaps = 0;
    NoProgress quiet;
    phantom::PhantomScan scan = phantom::makeScan(options, "HFS", quiet);
    return scan;
}

/// Of a part of the truth's grid, and the truth.
double dice(const InsideVolume& found, const InsideVolume& truth)
{
    const Index3 low = truth.grid.indexAt(found.grid.origin_mm);
    std::size_t both = 0, either = 0;
    for (std::size_t n = 0; n < found.voxels.size(); ++n) {
        const Index3 v = found.grid.indexOf(n);
        const bool is = found.voxels[n] != kOutside;
        const bool should = truth.valueOr({v.i + low.i, v.j + low.j, v.k + low.k}, kOutside) != kOutside;
        both += is && should;
        either += is;
    }
    either +=
        std::size_t(std::count_if(truth.voxels.begin(), truth.voxels.end(), [](auto v) { return v != kOutside; }));
    return 2 * double(both) / double(either);
}

class MrLumen : public testing::TestWithParam<phantom::MrLumen> {};

TEST_P(MrLumen, IsFoundWithItsPolarityAndItsLevels)
{
    const phantom::MrLumen contrast = GetParam();
    const std::string name = nameIn(phantom::kMrLumenNames, contrast);
    const phantom::PhantomScan scan = mrScan(contrast, 611);
    NoProgress quiet;
    const SignalSegmentation result = segmentSignal(scan.hu, {}, scan.truth.gravity, {}, {}, quiet);
    EXPECT_EQ(result.found.verdict, Verdict::found) << result.found.reason;
    EXPECT_EQ(result.found.measures["contrast"], name);
    EXPECT_EQ(std::count(result.found.inside.voxels.begin(), result.found.inside.voxels.end(), kFluid), 0);
    const double lumen = result.found.measures["lumen_signal"], tissue = result.found.measures["tissue_signal"];
    const double told = (contrast == phantom::MrLumen::dark ? kDarkLumen : kBrightLumen) / kTissue;
    EXPECT_NEAR(lumen / tissue, told, 0.15 * std::max(1.0, told));
    EXPECT_FALSE(result.found.measures.contains("noise_hu")) << "a signal has no HU";
    const TissueResult placed =
        findTissue(result.lumen_scale, result.found.inside, scan.truth.gravity, {}, 0, quiet, {});
    const double overlap = dice(placed.lumen, scan.truth.inside);
    std::printf("%s: dice %.4f, lumen %.0f, tissue %.0f\n", name.c_str(), overlap, lumen, tissue);
    EXPECT_GT(overlap, contrast == phantom::MrLumen::dark ? 0.94 : 0.97);
}

INSTANTIATE_TEST_SUITE_P(Contrasts, MrLumen, testing::Values(phantom::MrLumen::dark, phantom::MrLumen::bright));

TEST(MrLevels, AreToldByAGivenLumen)
{
    NoProgress quiet;
    for (const bool bright : {false, true}) {
        const phantom::PhantomScan scan = mrScan(bright ? phantom::MrLumen::bright : phantom::MrLumen::dark, 612);
        const HuVolume evened = evenedOut(scan.hu, shadingOf(scan.hu, quiet));
        const SignalLevels levels = levelsWithin(evened, scan.truth.inside, {});
        EXPECT_EQ(levels.contrast, bright ? LumenContrast::bright : LumenContrast::dark);
        const SignalSegmentation given = segmentSignal(scan.hu, scan.truth.inside, scan.truth.gravity, {}, {}, quiet);
        EXPECT_NE(given.found.verdict, Verdict::absent) << given.found.reason;
        EXPECT_GT(dice(given.found.inside, scan.truth.inside), 0.9);
    }
}

TEST(MrLevels, ThatAreSetComeFirst)
{
    const phantom::PhantomScan scan = mrScan(phantom::MrLumen::bright, 613);
    const SignalLevels levels = levelsOf(scan.hu, LumenContrast::bright, {.lumen_signal = 800, .tissue_signal = 300});
    EXPECT_EQ(levels.lumen, 800);
    EXPECT_EQ(levels.tissue, 300);
    EXPECT_EQ(levels.halfway(), 550);
}

TEST(MrShading, IsTakenOut)
{
    HuVolume signal;
    signal.grid.size = {64, 64, 64};
    signal.grid.spacing_mm = {4, 4, 4};
    signal.voxels.assign(signal.grid.voxelCount(), 0);
    const auto inBody = [](Index3 v) { return std::hypot(v.i - 31.5, v.j - 31.5) < 25; };
    for (std::size_t n = 0; n < signal.voxels.size(); ++n) {
        const Index3 v = signal.grid.indexOf(n);
        if (inBody(v))
            signal.voxels[n] = std::int16_t(std::lround((v.i / 8 + v.j / 8) % 2 ? 300 : 400) *
                                            std::exp(0.35 * (v.i - 31.5) / 25 + 0.2 * (v.k - 31.5) / 32));
    }
    NoProgress quiet;
    const HuVolume evened = evenedOut(signal, shadingOf(signal, quiet));
    const auto spread = [&](const HuVolume& of) {
        double sum = 0, squares = 0, count = 0;
        for (std::size_t n = 0; n < of.voxels.size(); ++n) {
            const Index3 v = of.grid.indexOf(n);
            if (!inBody(v) || (v.i / 8 + v.j / 8) % 2)
                continue;
            sum += of.voxels[n];
            squares += double(of.voxels[n]) * of.voxels[n];
            ++count;
        }
        const double mean = sum / count;
        return std::sqrt(squares / count - mean * mean) / mean;
    };
    EXPECT_GT(spread(signal), 0.2);
    EXPECT_LT(spread(evened), 0.05);
}

TEST(MrShading, LeavesPaddingAndAnEmptyScan)
{
    NoProgress quiet;
    HuVolume nothing;
    nothing.grid.size = {32, 32, 32};
    nothing.voxels.assign(nothing.grid.voxelCount(), 0);
    nothing.voxels[5] = kPaddingHu;
    const HuVolume evened = evenedOut(nothing, shadingOf(nothing, quiet));
    EXPECT_EQ(evened.voxels, nothing.voxels);
    const SignalSegmentation result = segmentSignal(nothing, {}, {0, 1, 0}, {}, {}, quiet);
    EXPECT_EQ(result.found.verdict, Verdict::absent);
    EXPECT_NE(result.found.reason.find("segment.contrast"), std::string::npos) << result.found.reason;
}

TEST(MrGivenLumen, ThatDoesNotStandOutIsRefused)
{
    const phantom::PhantomScan scan = mrScan(phantom::MrLumen::dark, 611);
    InsideVolume elsewhere(scan.hu.grid);
    const auto& size = scan.hu.grid.size;
    for (int k = 2; k < 12; ++k)
        for (int j = 2; j < 12; ++j)
            for (int i = 2; i < 12; ++i)
                elsewhere.at({i, j, k}) = 1;  // air around the body
    ASSERT_GT(size[0], 20);
    NoProgress quiet;
    EXPECT_THROW(onLumenScaleOf(scan.hu, elsewhere, {}, quiet), Error);
}

TEST(MrScan, IsToldByItsModality)
{
    Series series;
    series.modality = "MR";
    EXPECT_STREQ(unitOf(quantityOf(series)), "a.u.");
    series.modality = "CT";
    EXPECT_STREQ(unitOf(quantityOf(series)), "HU");
    series.modality.clear();
    EXPECT_EQ(quantityOf(series), Quantity::density);
}

}  // namespace
}  // namespace vicon::steps

// The default phantom (512 x 512 x 430) through resample, segment and skeleton, on seeds that nothing was tuned on:
// each prints what it measures, and the end tells worst and median of all that ran in this process.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "curve_errors.h"
#include "lumen_errors.h"
#include "vicon/phantom/phantom.h"
#include "vicon/steps/resample.h"
#include "vicon/steps/segment.h"
#include "vicon/steps/skeleton.h"
#include "vicon/steps/subdivide.h"

namespace vicon::test {
namespace {

constexpr std::uint64_t kFirstSeed = 272;
constexpr int kStudies = 20;

struct Figures {
    std::uint64_t seed = 0;
    std::string position, variant;
    LumenErrors lumen;
    CurveErrors curve;
    double polyp_mm = 0;
    bool ordered = false;
};

/// Each position, each number of gaps up to two, and now and then a low dose: all come with each other in twelve seeds.
phantom::PhantomOptions optionsFor(std::uint64_t seed)
{
    phantom::PhantomOptions options;
    options.seed = seed;
    options.gaps = int(seed % 3);
    options.low_dose = seed % 5 == 0;
    options.extras = false;
    return options;
}

std::string positionFor(std::uint64_t seed)
{
    constexpr const char* kPositions[] = {"HFS", "HFP", "FFS", "FFP"};
    return kPositions[seed % 4];
}

/// The segment of the inside voxel nearest to a point.
int segmentAt(const SegmentVolume& segments, Point3 point)
{
    constexpr int kReach = 4;
    const Index3 c = segments.grid.indexAt(point);
    int segment = 0;
    double least_mm = 1e9;
    for (int k = c.k - kReach; k <= c.k + kReach; ++k)
        for (int j = c.j - kReach; j <= c.j + kReach; ++j)
            for (int i = c.i - kReach; i <= c.i + kReach; ++i)
                if (const Index3 v{i, j, k}; segments.valueOr(v, 0))
                    if (const double d = distance(segments.grid.pointAt(v), point); d < least_mm) {
                        least_mm = d;
                        segment = segments.at(v);
                    }
    return segment;
}

/// Stations of polyps, each clicked on its side towards the lumen: as markers get theirs, among the stations of the
/// segment there. The nearest point of the whole curve may be one of a narrow loop behind a wide loop's wall.
void measurePolyps(const steps::Segmentation& found, const steps::SkeletonResult& skeleton,
                   const phantom::PhantomTruth& truth, Figures& figures)
{
    constexpr double kBeside_mm = 20;
    NoProgress quiet;
    const steps::Subdivided divided = steps::subdivide(found.inside, skeleton.curve, skeleton.voxels, {}, quiet);
    Skeleton curve;
    curve.pieces.push_back({false, truth.curve});
    for (const phantom::Polyp& polyp : truth.polyps) {
        const Vector3 into_lumen = normalized(curve.at(polyp.station_mm).position_mm - polyp.position_mm);
        const Point3 clicked = polyp.position_mm + into_lumen * (polyp.diameter_mm / 2);
        const int segment = segmentAt(divided.segments, clicked);
        ASSERT_GT(segment, 0) << "no lumen at the polyp at " << polyp.station_mm;
        const auto& range = divided.description.segments.at(std::size_t(segment) - 1);
        const double station_mm =
            skeleton.curve.nearest(clicked, range.from_station_mm - kBeside_mm, range.to_station_mm + kBeside_mm)
                .station_mm;
        figures.polyp_mm = std::max(figures.polyp_mm, std::abs(station_mm - polyp.station_mm));
    }
}

std::vector<Figures>& allFigures()
{
    static std::vector<Figures> all;
    return all;
}

void print(const Figures& f)
{
    std::printf(
        "seed %d %s %s: dice %.4f, outside %.2f ml (%.2f ml of it over half a voxel's diagonal), missed %.2f (%.2f) "
        "ml, "
        "surface 95 %% %.2f mm; pieces %s, curve mean %.2f, 95 %% %.2f mm, length %+.2f %%, polyp station %.1f mm, "
        "direction %s\n",
        int(f.seed), f.position.c_str(), f.variant.c_str(), f.lumen.dice, f.lumen.outside_ml, f.lumen.far_outside_ml,
        f.lumen.missed_ml, f.lumen.far_missed_ml, f.lumen.surface_95_mm, f.ordered ? "right" : "WRONG", f.curve.mean_mm,
        f.curve.p95_mm, 100 * f.curve.length_fraction, f.polyp_mm, f.curve.directed ? "right" : "WRONG");
    std::fflush(stdout);
}

double tell(const char* name, bool more_is_worse, double (*value)(const Figures&))
{
    std::vector<double> values;
    for (const Figures& f : allFigures())
        values.push_back(value(f));
    std::sort(values.begin(), values.end());
    const double median = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
    std::printf("%-32s median %8.4f  worst %8.4f\n", name, median, more_is_worse ? values.back() : values.front());
    return median;
}

class Family : public testing::TestWithParam<int> {
protected:
    static void TearDownTestSuite()
    {
        if (allFigures().size() < 2)
            return;
        std::printf("%zu seeds\n", allFigures().size());
        EXPECT_GE(tell("dice", false, [](const Figures& f) { return f.lumen.dice; }), 0.985);
        tell("outside, nearest voxel, ml", true, [](const Figures& f) { return f.lumen.outside_ml; });
        tell("outside by half a diagonal, ml", true, [](const Figures& f) { return f.lumen.far_outside_ml; });
        tell("missed, nearest voxel, ml", true, [](const Figures& f) { return f.lumen.missed_ml; });
        tell("missed by half a diagonal, ml", true, [](const Figures& f) { return f.lumen.far_missed_ml; });
        tell("surface distance 95 %, mm", true, [](const Figures& f) { return f.lumen.surface_95_mm; });
        tell("curve mean, mm", true, [](const Figures& f) { return f.curve.mean_mm; });
        tell("curve 95 %, mm", true, [](const Figures& f) { return f.curve.p95_mm; });
        tell("length, share", true, [](const Figures& f) { return std::abs(f.curve.length_fraction); });
        tell("polyp station, mm", true, [](const Figures& f) { return f.polyp_mm; });
    }
};

TEST_P(Family, UnseenPhantomIsSegmentedAndFollowed)
{
    NoProgress quiet;
    Figures figures;
    figures.seed = kFirstSeed + std::uint64_t(GetParam());
    figures.position = positionFor(figures.seed);
    const phantom::PhantomOptions options = optionsFor(figures.seed);
    figures.variant = std::to_string(options.gaps) + " gaps" + (options.low_dose ? ", low dose" : "");
    phantom::PhantomScan scan = phantom::makeScan(options, figures.position, quiet);
    const HuVolume volume = steps::resample(std::move(scan.hu), {}, quiet);
    const steps::Segmentation found = steps::segmentColon(volume, scan.truth.gravity, {}, quiet);
    EXPECT_EQ(found.verdict, Verdict::found) << found.reason;
    ASSERT_FALSE(found.inside.voxels.empty());
    const steps::SkeletonResult skeleton = steps::findSkeleton(found.inside, found.plan, {}, quiet);
    const Skeleton& curve = skeleton.curve;
    figures.lumen = lumenErrors(volume, found.inside, scan.truth.inside);
    figures.ordered = piecesInOrder(curve, scan.truth);
    figures.curve = curveErrors(curve, scan.truth);
    measurePolyps(found, skeleton, scan.truth, figures);
    print(figures);
    allFigures().push_back(figures);
    EXPECT_GE(figures.lumen.dice, 0.975);
    EXPECT_LT(figures.lumen.far_outside_ml, 2);
    EXPECT_LT(figures.lumen.surface_95_mm, 0.7);
    EXPECT_TRUE(figures.ordered);
    EXPECT_TRUE(figures.curve.directed);
    EXPECT_LE(figures.curve.mean_mm, 0.4);
    EXPECT_LE(figures.curve.p95_mm, 1.0);
    EXPECT_LE(std::abs(figures.curve.length_fraction), 0.01);
    EXPECT_LE(figures.polyp_mm, 2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Family, testing::Range(0, kStudies));

}  // namespace
}  // namespace vicon::test

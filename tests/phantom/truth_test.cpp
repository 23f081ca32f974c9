#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "euler.h"
#include "scans.h"

namespace vicon::phantom {
namespace {

struct Variant {
    const char* name;
    void (*change)(PhantomOptions&);
    int pieces, euler;
};

void PrintTo(const Variant& variant, std::ostream* out)
{
    *out << variant.name;
}

class LumenOfVariant : public ::testing::TestWithParam<Variant> {};

TEST_P(LumenOfVariant, HangsTogetherButForItsGapsAndHasNoLoopsButItsContacts)
{
    PhantomOptions options = smallOptions(2);
    GetParam().change(options);
    const PhantomScan scan = scanOf(options);
    EXPECT_EQ(countedPieces(scan.truth.inside), GetParam().pieces);
    EXPECT_EQ(countedEulerNumber(scan.truth.inside), GetParam().euler);
    EXPECT_EQ(scan.truth.euler_number, GetParam().euler);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, LumenOfVariant,
    ::testing::Values(Variant{"without_gap", [](PhantomOptions& o) { o.gaps = 0; }, 1, 1},
                      Variant{"one_gap", [](PhantomOptions&) {}, 2, 2},
                      Variant{"two_gaps", [](PhantomOptions& o) { o.gaps = 2; }, 3, 3},
                      Variant{"self_contact", [](PhantomOptions& o) { o.gaps = 0, o.self_contact = true; }, 1, 0},
                      Variant{"thin_walls", [](PhantomOptions& o) { o.gaps = 0, o.thin_walls = true; }, 1, 1},
                      Variant{"no_catheter", [](PhantomOptions& o) { o.gaps = 0, o.catheter = false; }, 1, 1}),
    [](const auto& test) { return test.param.name; });

TEST(PhantomTruth, GivesTheVolumeOfItsVoxels)
{
    const PhantomTruth& truth = cleanScan().truth;
    std::size_t inside = 0, fluid = 0;
    for (const std::uint8_t label : truth.inside.voxels) {
        inside += label != kOutside;
        fluid += label == kFluid;
    }
    const double voxel_ml = truth.inside.grid.voxelVolume_mm3() / 1000;
    EXPECT_NEAR(truth.volume_ml, double(inside) * voxel_ml, 1e-6);
    EXPECT_NEAR(truth.fluid_ml, double(fluid) * voxel_ml, 1e-6);
    EXPECT_GT(truth.fluid_ml, 10);
}

TEST(PhantomTruth, OfASmoothTubeHasTheVolumeByPappus)
{
    PhantomOptions options = smallOptions();
    options.size = {192, 192, 160};
    options.folds = options.catheter = options.fluid = false;
    options.gaps = options.polyps = 0;
    const PhantomTruth truth = scanOf(options).truth;
    constexpr double pi = std::numbers::pi;
    const auto cap_mm3 = [](double r) { return 2.0 / 3 * pi * r * r * r; };
    double expected_mm3 = cap_mm3(truth.curve.front().radius_mm) + cap_mm3(truth.curve.back().radius_mm);
    for (std::size_t n = 1; n < truth.curve.size(); ++n)
        expected_mm3 += pi * std::pow((truth.curve[n].radius_mm + truth.curve[n - 1].radius_mm) / 2, 2) *
                        (truth.curve[n].station_mm - truth.curve[n - 1].station_mm);
    EXPECT_NEAR(truth.volume_ml, expected_mm3 / 1000, 0.01 * truth.volume_ml);
}

TEST(PhantomTruth, HasACurveInsideTheLumenButForGaps)
{
    const PhantomTruth& truth = cleanScan().truth;
    ASSERT_EQ(truth.gaps.size(), 1U);
    EXPECT_GE(truth.gaps[0].to_mm - truth.gaps[0].from_mm, 10);
    EXPECT_LE(truth.gaps[0].to_mm - truth.gaps[0].from_mm, 40);
    for (std::size_t n = 0; n < truth.curve.size(); ++n) {
        const SkeletonPoint& point = truth.curve[n];
        if (n > 0) {
            EXPECT_NEAR(point.station_mm - truth.curve[n - 1].station_mm,
                        distance(point.position_mm, truth.curve[n - 1].position_mm), 0.01);
        }
        constexpr double kVoxel_mm = 4;
        const bool in_gap = point.station_mm >= truth.gaps[0].from_mm + kVoxel_mm &&
                            point.station_mm <= truth.gaps[0].to_mm - kVoxel_mm;
        const bool near_gap =
            point.station_mm > truth.gaps[0].from_mm - 6 && point.station_mm < truth.gaps[0].to_mm + 6;
        const bool in_tube = point.station_mm < 60;
        const auto label = truth.inside.at(truth.inside.grid.indexAt(point.position_mm));
        if (in_gap) {
            EXPECT_EQ(label, kOutside) << "collapsed at station " << point.station_mm;
        } else if (!near_gap && !in_tube) {
            EXPECT_NE(label, kOutside) << "open at station " << point.station_mm;
        }
    }
    EXPECT_NEAR(truth.curve.back().station_mm, truth.length_mm, 1e-6);
}

TEST(PhantomTruth, EndsTheCurveOneRadiusInsideTheTips)
{
    const PhantomTruth& truth = cleanScan().truth;
    for (const bool rectal : {true, false}) {
        const SkeletonPoint& end = rectal ? truth.curve.front() : truth.curve.back();
        const SkeletonPoint& next = rectal ? truth.curve[5] : truth.curve[truth.curve.size() - 6];
        const Vector3 outward = normalized(end.position_mm - next.position_mm);
        const auto& grid = truth.inside.grid;
        const Vector3 aside =
            normalized(cross(outward, Vector3{1, 0, 0})) * -7.0;  // on the other side than the rectal tube
        const auto labelAt = [&](double along) {
            return truth.inside.at(grid.indexAt(end.position_mm + outward * along + aside));
        };
        const double here = std::sqrt(end.radius_mm * end.radius_mm - 49);
        EXPECT_NE(labelAt(here - 3.5), kOutside);
        EXPECT_EQ(labelAt(here + 3.5), kOutside);
    }
}

/// The middle of the abdomen in voxels of 1 mm, without noise.
const PhantomScan& fineScan()
{
    static const PhantomScan scan = [] {
        PhantomOptions options;
        options.seed = 4;
        options.size = {256, 208, 160};
        options.spacing_mm = {1, 1, 1};
        options.polyps = 8;
        options.noise_hu = 0;
        return scanOf(options);
    }();
    return scan;
}

TEST(PhantomTruth, PutsPolypsOnTheWallAtTheirStation)
{
    const PhantomScan& scan = fineScan();
    ASSERT_EQ(scan.truth.polyps.size(), 8U);
    int seen = 0;
    for (const Polyp& polyp : scan.truth.polyps) {
        const SkeletonPoint* nearest = &scan.truth.curve.front();
        for (const SkeletonPoint& point : scan.truth.curve)
            if (std::abs(point.station_mm - polyp.station_mm) < 30 &&
                distance(point.position_mm, polyp.position_mm) < distance(nearest->position_mm, polyp.position_mm))
                nearest = &point;
        EXPECT_NEAR(nearest->station_mm, polyp.station_mm, 1.5);
        EXPECT_GE(polyp.diameter_mm, 5);
        EXPECT_LE(polyp.diameter_mm, 10);
        const Index3 centre = scan.hu.grid.indexAt(polyp.position_mm);
        const Vector3 inward = normalized(nearest->position_mm - polyp.position_mm);
        const Index3 beyond = scan.hu.grid.indexAt(polyp.position_mm + inward * (polyp.diameter_mm / 2 + 1.5));
        if (!scan.hu.grid.contains(centre) || !scan.hu.grid.contains(beyond) || scan.hu.at(centre) == kPaddingHu)
            continue;
        ++seen;
        EXPECT_EQ(scan.truth.inside.at(centre), kOutside);
        EXPECT_GT(scan.hu.at(centre), -120) << "soft tissue, less what the blur takes from 5 mm";
        EXPECT_NE(scan.truth.inside.at(beyond), kOutside);
    }
    EXPECT_GE(seen, 3);
}

TEST(PhantomTruth, GivesPolypsTheirDiameterAlongTheWall)
{
    // Measured as a reader would: across the head, half a radius inside the ball's middle.
    const PhantomScan& scan = fineScan();
    for (const Polyp& polyp : scan.truth.polyps) {
        std::size_t n = 0;
        while (scan.truth.curve[n].station_mm < polyp.station_mm - 1e-6)
            ++n;
        const Vector3 inward = normalized(scan.truth.curve[n].position_mm - polyp.position_mm);
        const Vector3 along = normalized(scan.truth.curve[n + 1].position_mm - scan.truth.curve[n - 1].position_mm);
        const double radius_mm = polyp.diameter_mm / 2;
        const Point3 middle = polyp.position_mm + inward * (0.5 * radius_mm);
        double width_mm = 0;
        bool in_field = true;
        for (double t = -12; t <= 12; t += 0.1) {
            const Index3 v = scan.hu.grid.indexAt(middle + along * t);
            in_field = in_field && scan.hu.grid.contains(v);
            if (in_field && std::abs(t) < radius_mm + 2)
                width_mm += scan.truth.inside.at(v) == kOutside ? 0.1 : 0;
        }
        if (in_field) {
            EXPECT_NEAR(width_mm, 2 * radius_mm * std::sqrt(0.75), 1.5) << "station " << polyp.station_mm;
        }
    }
}

TEST(PhantomTruth, ShowsFoldsThatNarrowTheLumen)
{
    const PhantomTruth& truth = cleanScan().truth;
    int folds = 0;
    for (std::size_t n = 9; n + 9 < truth.curve.size(); ++n) {
        const double r = truth.curve[n].radius_mm;
        folds += r > 0 && r < truth.curve[n - 9].radius_mm - 3 && r < truth.curve[n + 9].radius_mm - 3 &&
                 r <= truth.curve[n - 1].radius_mm && r <= truth.curve[n + 1].radius_mm;
    }
    EXPECT_GT(folds, 25);
    PhantomOptions smooth = smallOptions();
    smooth.folds = false;
    smooth.gaps = 0;
    const PhantomTruth plain = scanOf(smooth).truth;
    for (std::size_t n = 1; n < plain.curve.size(); ++n)
        EXPECT_LT(std::abs(plain.curve[n].radius_mm - plain.curve[n - 1].radius_mm), 0.6);
}

TEST(PhantomTruth, IsDescribedInJsonWithUnits)
{
    const nlohmann::json json = describeTruth(cleanScan().truth);
    EXPECT_EQ(json["curve_mm"].size(), json["station_mm"].size());
    EXPECT_EQ(json["curve_mm"].size(), json["radius_mm"].size());
    EXPECT_EQ(json["curve_mm"][7][2].get<double>(), cleanScan().truth.curve[7].position_mm.z);
    EXPECT_EQ(json["polyps"].size(), 5U);
    EXPECT_EQ(json["polyps"][0]["diameter_mm"].get<double>(), cleanScan().truth.polyps[0].diameter_mm);
    EXPECT_EQ(json["gaps"].size(), 1U);
    EXPECT_EQ(json["volume_ml"].get<double>(), cleanScan().truth.volume_ml);
}

}  // namespace
}  // namespace vicon::phantom

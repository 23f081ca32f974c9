#include "vicon/cases/finding_facts.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "marker_samples.h"

namespace vicon {
namespace {

using testing::DoubleEq;
using testing::Optional;

constexpr Vector3 kHeadward{0, 0, 1}, kFootward{0, 0, -1}, kLeftward{1, 0, 0}, kPosterior{0, 1, 0};

TEST(ClockFace, HasTwelveInFrontAndRunsClockwiseAsSeenFromTheAnus)
{
    const struct {
        const char* what;
        Vector3 tangent, to_wall;
        int hour;
    } cases[] = {
        // Rectum and descending colon run headward: who looks along them has the patient's left on the right hand.
        {"front", kHeadward, {0, -20, 0}, 12},
        {"patient's left", kHeadward, {20, 0, 0}, 3},
        {"back", kHeadward, {0, 20, 0}, 6},
        {"patient's right", kHeadward, {-20, 0, 0}, 9},
        {"front left", kHeadward, {10, -17.3, 0}, 1},
        // The ascending colon runs footward from the flexure: left and right change sides.
        {"front, footward", kFootward, {0, -20, 0}, 12},
        {"patient's left, footward", kFootward, {20, 0, 0}, 9},
        {"patient's right, footward", kFootward, {-20, 0, 0}, 3},
        // The transverse colon runs to the patient's right.
        {"head, towards the right", {-1, 0, 0}, {0, 0, 20}, 3},
        {"feet, towards the right", {-1, 0, 0}, {0, 0, -20}, 9},
        {"head, towards the left", kLeftward, {0, 0, 20}, 9},
        // What lies along the colon does not turn the face.
        {"ahead and left", kHeadward, {20, 0, 50}, 3},
    };
    for (const auto& c : cases)
        EXPECT_THAT(clockFace(Point3{5, 6, 7} + c.to_wall, {5, 6, 7}, c.tangent), Optional(c.hour)) << c.what;
}

TEST(ClockFace, IsNotGivenWhereItMeansNothing)
{
    EXPECT_FALSE(clockFace({20, 0, 0}, {0, 0, 0}, kPosterior)) << "the colon runs from front to back";
    EXPECT_FALSE(clockFace({0, -0.5, 3}, {0, 0, 0}, kHeadward)) << "on the centreline";
    const auto tilted = [](double degrees) {
        const double a = degrees * std::numbers::pi / 180;
        return clockFace({20, 0, 0}, {0, 0, 0}, {0, std::cos(a), std::sin(a)});
    };
    EXPECT_FALSE(tilted(14));
    EXPECT_THAT(tilted(16), Optional(3));
}

TEST(EndoscopeDistance, TakesThePublishedFactorsAndAFifthEitherWay)
{
    const auto about = [](std::optional<ColonPart> part) { return endoscopeDistance(1000, part).about_mm; };
    EXPECT_DOUBLE_EQ(about(ColonPart::caecum), 570);
    EXPECT_DOUBLE_EQ(about(ColonPart::ascending), 590);
    EXPECT_DOUBLE_EQ(about(ColonPart::sigmoid), 780);
    EXPECT_DOUBLE_EQ(about(std::nullopt), 685);
    EXPECT_DOUBLE_EQ(endoscopeDistance(1000, ColonPart::sigmoid).least_mm, 624);
    EXPECT_DOUBLE_EQ(endoscopeDistance(1000, ColonPart::sigmoid).most_mm, 936);
    EXPECT_DOUBLE_EQ(endoscopeDistance(1000, ColonPart::transverse).least_mm, 472);
    EXPECT_DOUBLE_EQ(endoscopeDistance(1000, ColonPart::transverse).most_mm, 936);
}

TEST(LargestDiameter, IsTheLongestStraightLineAndNeverTheWayAlongTheWall)
{
    EXPECT_EQ(largestDiameter_mm({.straight_mm = 5.5, .along_mm = 6.7, .plane = PlaneSize{.diameter_mm = 5.9}}), 5.9);
    EXPECT_EQ(largestDiameter_mm({.straight_mm = 6.1, .along_mm = 6.7, .plane = PlaneSize{.diameter_mm = 5.9}}), 6.1);
    EXPECT_EQ(largestDiameter_mm({.straight_mm = 5.5, .along_mm = 9}), 5.5);
}

/// Two sights of one polyp: 300 mm from the rectum in one scan, 330 mm in the other.
class Facts : public testing::Test {
protected:
    Finding finding_{.id = "f1", .markers = {"m1", "m2"}};
    std::vector<Marker> markers_{at("m1", "s1", 300), at("m2", "s2", 330)};

    static Marker at(const std::string& id, const std::string& scan, double station_mm)
    {
        Marker m{.id = id, .scan_id = scan};
        m.station_mm = station_mm;
        m.from_caecum_mm = 1500 - station_mm;
        m.fraction = station_mm / 1500;
        m.part = ColonPart::sigmoid;
        return m;
    }
    FindingFacts facts(const std::map<std::string, Skeleton>& skeletons = {}) const
    {
        return factsOf(finding_, markers_, skeletons);
    }
};

TEST_F(Facts, TakeTheLargestOfAllSightsAndItsPlace)
{
    markers_[0].size = MarkerSize{.straight_mm = 6.12, .plane = PlaneSize{.diameter_mm = 6.96}};
    markers_[1].size = MarkerSize{.straight_mm = 7.31};
    EXPECT_THAT(facts().size_mm, Optional(DoubleEq(7.3)));
    EXPECT_EQ(facts().size_source, SizeSource::surface);
    EXPECT_THAT(facts().size_2d_mm, Optional(DoubleEq(7.0)));
    EXPECT_THAT(facts().size_3d_mm, Optional(DoubleEq(7.3)));
    EXPECT_EQ(facts().lead()->marker_id, "m2");
    markers_[0].size->plane->diameter_mm = 7.3;
    EXPECT_EQ(facts().size_source, SizeSource::plane);
    EXPECT_EQ(facts().lead()->marker_id, "m1") << "of equal ones the first";
}

TEST_F(Facts, OfAnOutlineHaveItsBoundsAndItsBestPlaneBesideTheDiameter)
{
    const PolypSize polyp{.diameter_mm = 7.3,
                          .least_mm = 7.1,
                          .most_mm = 7.5,
                          .volume_ml = 0.2,
                          .volume_least_ml = 0.18,
                          .volume_most_ml = 0.22};
    markers_[0].size = MarkerSize{.straight_mm = 7.3, .plane = PlaneSize{.diameter_mm = 7.29}, .polyp = polyp};
    EXPECT_EQ(facts().size_source, SizeSource::surface) << "of an outline the largest in space leads";
    EXPECT_THAT(facts().size_2d_mm, Optional(DoubleEq(7.3)));
    EXPECT_EQ(facts().lead()->volume_least_ml, 0.18);
    EXPECT_EQ(factsFromJson(toJson(facts())).lead()->volume_most_ml, 0.22);
    EXPECT_EQ(markerSizeFromJson(toJson(*markers_[0].size)).polyp->volume_most_ml, 0.22);
    auto without = toJson(*markers_[0].size);
    without["polyp"].erase("volume_least_ml");
    EXPECT_FALSE(markerSizeFromJson(without).polyp->volume_least_ml) << "as outlines were kept before";
}

TEST_F(Facts, SayThatASizeLiesInASliceAndNotOnTheSurface)
{
    markers_[0].size = MarkerSize{.straight_mm = 7.04, .in_slice = true};
    EXPECT_EQ(facts().size_source, SizeSource::slice);
    EXPECT_THAT(facts().size_2d_mm, Optional(DoubleEq(7.0)));
    EXPECT_FALSE(facts().size_3d_mm);
    markers_[1].size = MarkerSize{.straight_mm = 7.3, .plane = PlaneSize{.diameter_mm = 6.9}};
    EXPECT_EQ(facts().size_source, SizeSource::surface);
    EXPECT_TRUE(facts().size_in_slice) << "the larger of the two in a plane";
    const FindingFacts again = factsFromJson(toJson(facts()));
    EXPECT_TRUE(again.sights[0].size_in_slice && !again.sights[1].size_in_slice && again.size_in_slice);
    markers_[1].size->plane->diameter_mm = 7.5;
    EXPECT_EQ(facts().size_source, SizeSource::plane);
    EXPECT_TRUE(markerSizeFromJson(toJson(*markers_[0].size)).in_slice);
}

TEST_F(Facts, LetTheReadersSizeCount)
{
    markers_[1].size = MarkerSize{.straight_mm = 12};
    finding_.read_size_mm = 9.94;
    EXPECT_THAT(facts().size_mm, Optional(DoubleEq(9.9)));
    EXPECT_EQ(facts().size_source, SizeSource::reader);
    EXPECT_THAT(facts().size_3d_mm, Optional(DoubleEq(12))) << "what was measured stays";
    EXPECT_EQ(facts().lead()->marker_id, "m2");
}

TEST_F(Facts, ArePlacedByTheFirstSightWhereNoneWasMeasured)
{
    EXPECT_FALSE(facts().size_mm);
    EXPECT_EQ(facts().lead()->marker_id, "m1");
    EXPECT_DOUBLE_EQ(facts().endoscope->about_mm, 234);
    EXPECT_DOUBLE_EQ(facts().endoscope->least_mm, 300 * 0.78 * 0.8);
    EXPECT_DOUBLE_EQ(facts().endoscope->most_mm, 330 * 0.78 * 1.2) << "over both sights";
}

TEST_F(Facts, PassOverAMarkerThatWasDeleted)
{
    finding_.markers = {"m9", "m2"};
    ASSERT_EQ(facts().sights.size(), 1u);
    EXPECT_EQ(facts().lead()->marker_id, "m2");
    finding_.markers = {"m9"};
    EXPECT_FALSE(facts().leading);
    EXPECT_FALSE(facts().endoscope);
}

TEST_F(Facts, HaveAClockFaceWhereTheScanHasACentreline)
{
    Skeleton up;
    up.pieces = {{false, {{{10, 20, 0}, 0, 15}, {{10, 20, 1500}, 1500, 15}}}};
    markers_[0].position_mm = {30, 20, 300};
    const FindingFacts found = facts({{"s1", up}});
    EXPECT_THAT(found.sights[0].clock_hour, Optional(3));
    EXPECT_FALSE(found.sights[1].clock_hour);
}

TEST_F(Facts, AreReadBackFromTheirJson)
{
    markers_[0] = test::markerWithEverything();
    markers_[0].station_mm = 300;
    const FindingFacts found = facts();
    EXPECT_EQ(toJson(factsFromJson(toJson(found))), toJson(found));
    EXPECT_THAT(found.mean_hu, Optional(41.5));
}

}  // namespace
}  // namespace vicon

// Where a finding of an earlier report should lie today, and what lies there.
#include "vicon/cases/prior_match.h"

#include <gmock/gmock.h>

namespace vicon {
namespace {

using testing::HasSubstr;

/// Eight parts of 200 mm.
ColonPartRanges evenParts()
{
    ColonPartRanges parts;
    for (int n = 0; n < 8; ++n)
        parts.push_back({ColonPart(n), 200.0 * n, 200.0 * (n + 1)});
    return parts;
}

const ScanColon kSupine{"s1", "supine", 1600, evenParts()};

PriorSight sight(std::optional<ColonPart> part, std::optional<double> part_fraction,
                 std::optional<double> fraction = {}, const std::string& series = {})
{
    PriorSight s;
    s.series_uid = series;
    s.part = part;
    s.part_fraction = part_fraction;
    s.fraction = fraction;
    return s;
}

PriorReport reportOf(std::vector<PriorFinding> findings)
{
    PriorReport report{.sop_uid = "1.2"};
    report.findings = std::move(findings);
    return report;
}

PriorFinding prior(const std::string& uid, PriorSight at, FindingKind kind = FindingKind::polyp)
{
    PriorFinding f{.uid = uid, .kind = kind};
    f.sights = {std::move(at)};
    return f;
}

FindingWithFacts today(const std::string& id, double station_mm, FindingKind kind = FindingKind::polyp)
{
    FindingWithFacts one;
    one.finding.id = id;
    one.finding.kind = kind;
    one.facts.sights.push_back({.marker_id = "m" + id, .scan_id = "s1", .station_mm = station_mm});
    one.facts.leading = 0;
    return one;
}

std::vector<PriorMatch> match(const PriorReport& report, const std::vector<FindingWithFacts>& now)
{
    return matchFindings(report, now, {kSupine}, {});
}

TEST(ExpectedPlace, IsTheFractionInsideThePart)
{
    const auto finding = prior("a", sight(ColonPart::transverse, 0.25, 0.9));
    const auto place = expectedIn(reportOf({finding}), finding, kSupine, {});
    ASSERT_TRUE(place);
    EXPECT_DOUBLE_EQ(place->station_mm, 850) << "the transverse colon is from 800 to 1000 mm";
    EXPECT_DOUBLE_EQ(place->least_mm, 850 - 80) << "five percent of 1600 mm";
    EXPECT_DOUBLE_EQ(place->most_mm, 850 + 80);
    EXPECT_EQ(place->by, "fraction inside the transverse");
}

TEST(ExpectedPlace, IsThatOfTheWholeColonOrThePartWhereNoMoreIsKnown)
{
    const auto whole = prior("a", sight(ColonPart::transverse, {}, 0.5));
    EXPECT_DOUBLE_EQ(expectedIn(reportOf({whole}), whole, kSupine, {})->station_mm, 800);
    const auto part = prior("a", sight(ColonPart::sigmoid, {}));
    const auto place = expectedIn(reportOf({part}), part, kSupine, {});
    EXPECT_DOUBLE_EQ(place->least_mm, 200 - 80);
    EXPECT_DOUBLE_EQ(place->most_mm, 400 + 80);
    EXPECT_EQ(place->by, "anywhere in the sigmoid");
    const auto none = prior("a", sight({}, {}));
    EXPECT_FALSE(expectedIn(reportOf({none}), none, kSupine, {}));
    const ScanColon unknown{"s1", "supine", 1600, {}};
    EXPECT_FALSE(expectedIn(reportOf({part}), part, unknown, {})) << "today's parts are not known";
}

TEST(ExpectedPlace, IsByTheSightOfTheSamePosition)
{
    PriorFinding finding = prior("a", sight(ColonPart::sigmoid, 0.1, {}, "1.1"));
    finding.sights.push_back(sight(ColonPart::sigmoid, 0.9, {}, "1.2"));
    PriorReport report = reportOf({finding});
    report.scans = {{"1.1", "prone", "", 0}, {"1.2", "supine", "", 0}};
    EXPECT_DOUBLE_EQ(expectedIn(report, finding, kSupine, {})->station_mm, 200 + 0.9 * 200);
    report.scans.clear();
    EXPECT_DOUBLE_EQ(expectedIn(report, finding, kSupine, {})->station_mm, 200 + 0.1 * 200) << "the leading one";
}

TEST(Match, IsProposedWhereOneFindingLiesWithinTheWindow)
{
    const auto matches = match(reportOf({prior("a", sight(ColonPart::sigmoid, 0.5))}),
                               {today("f1", 379.9), today("f2", 380.1), today("f3", 1500)});
    ASSERT_EQ(matches.size(), 1u);
    ASSERT_EQ(matches[0].candidates.size(), 1u) << "380.1 is more than 80 mm away";
    EXPECT_EQ(matches[0].candidates[0].finding_id, "f1");
    EXPECT_NEAR(matches[0].candidates[0].off_mm, 79.9, 1e-9);
    EXPECT_TRUE(matches[0].alone);
}

TEST(Match, CrossesTheBorderOfAPart)
{
    const auto matches = match(reportOf({prior("a", sight(ColonPart::sigmoid, 0.95))}), {today("f1", 410)});
    ASSERT_EQ(matches[0].candidates.size(), 1u) << "20 mm on, in the descending colon";
}

TEST(Match, IsAmbiguousWhereSeveralLieThere)
{
    const auto two_now =
        match(reportOf({prior("a", sight(ColonPart::sigmoid, 0.5))}), {today("f1", 350), today("f2", 290)});
    EXPECT_FALSE(two_now[0].alone);
    EXPECT_EQ(two_now[0].candidates.at(0).finding_id, "f2") << "the nearest first";
    const auto two_then =
        match(reportOf({prior("a", sight(ColonPart::sigmoid, 0.5)), prior("b", sight(ColonPart::sigmoid, 0.6))}),
              {today("f1", 300)});
    EXPECT_FALSE(two_then[0].alone || two_then[1].alone) << "neither is sure to be this one";
}

TEST(Match, IsByTheNearestOfAFindingsSights)
{
    FindingWithFacts both = today("f1", 350);
    both.facts.sights.push_back({.marker_id = "m2", .scan_id = "s1", .station_mm = 290});
    both.facts.sights.push_back({.marker_id = "m3", .scan_id = "s1", .station_mm = 330});
    const auto matches = match(reportOf({prior("a", sight(ColonPart::sigmoid, 0.5))}), {both});
    ASSERT_EQ(matches[0].candidates.size(), 1u);
    EXPECT_NEAR(matches[0].candidates[0].off_mm, -10, 1e-9);
}

TEST(Match, IsOfAKind)
{
    const auto count = [](FindingKind then, FindingKind now) {
        return match(reportOf({prior("a", sight(ColonPart::sigmoid, 0.5), then)}), {today("f1", 300, now)})
            .at(0)
            .candidates.size();
    };
    EXPECT_EQ(count(FindingKind::polyp, FindingKind::mass), 1u);
    EXPECT_EQ(count(FindingKind::lipoma, FindingKind::lipoma), 1u);
    EXPECT_EQ(count(FindingKind::lipoma, FindingKind::polyp), 0u);
    EXPECT_EQ(count(FindingKind::stool, FindingKind::stool), 0u) << "stool moves";
    PriorFinding unknown = prior("a", sight(ColonPart::sigmoid, 0.5));
    unknown.kind.reset();
    EXPECT_EQ(match(reportOf({unknown}), {today("f1", 300)})[0].candidates.size(), 1u);
}

TEST(Match, IsNoneWhereNothingIsToldOfThePlace)
{
    EXPECT_TRUE(match(reportOf({prior("a", sight({}, {}))}), {today("f1", 300)})[0].candidates.empty());
    PriorFinding nowhere{.uid = "a"};
    EXPECT_TRUE(match(reportOf({nowhere}), {today("f1", 300)})[0].candidates.empty());
}

}  // namespace
}  // namespace vicon

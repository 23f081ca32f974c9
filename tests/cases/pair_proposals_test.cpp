#include "vicon/cases/pair_proposals.h"

#include <gmock/gmock.h>

#include "vicon/cases/marker_groups.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

using testing::HasSubstr;

/// Two scans with the second drawn out by a tenth, sure to 10 mm either way.
ScanMatch match()
{
    ScanMatch made{"s1", "s2", {MapSource::wall, 1000, 1100, {}, {}}};
    for (double s = 0; s <= 1000; s += 10) {
        made.map.from_mm.push_back(s);
        made.map.to.push_back({1.1 * s, 1.1 * s - 10, 1.1 * s + 10});
    }
    return made;
}

Marker marker(const std::string& id, const std::string& scan, double station_mm, double size_mm = 0)
{
    Marker made{.id = id, .scan_id = scan, .station_mm = station_mm};
    if (size_mm > 0) {
        made.size.emplace();
        made.size->straight_mm = size_mm;
    }
    return made;
}

TEST(PairProposals, AreTheMarkersOfOnePlaceWithTheirReason)
{
    const auto proposals =
        proposePairs({marker("m1", "s1", 500, 7), marker("m2", "s2", 553, 7.4), marker("m3", "s2", 900, 7)}, {match()});
    ASSERT_EQ(proposals.size(), 1U);
    EXPECT_EQ(proposals[0].first, "m1");
    EXPECT_EQ(proposals[0].second, "m2");
    EXPECT_NEAR(proposals[0].off_mm, 3, 1e-9);
    EXPECT_TRUE(proposals[0].within);
    EXPECT_EQ(proposals[0].rank, 1);
    EXPECT_EQ(proposals[0].rivals, 0);
    EXPECT_THAT(proposals[0].reason,
                HasSubstr("3 mm from the same place, within the interval of 20 mm; 7.0 and 7.4 mm"));
}

TEST(PairProposals, AnotherThatFitsAboutAsWellIsRankedAfterItAndSaidToBe)
{
    const auto proposals =
        proposePairs({marker("m1", "s1", 500), marker("m2", "s2", 552), marker("m3", "s2", 546)}, {match()});
    ASSERT_EQ(proposals.size(), 2U);
    EXPECT_EQ(proposals[0].second, "m2");
    EXPECT_EQ(proposals[1].second, "m3");
    EXPECT_EQ(proposals[1].rank, 2);
    EXPECT_EQ(proposals[0].rivals, 1);
    EXPECT_THAT(proposals[0].reason, HasSubstr("one other fits about as well"));
}

TEST(PairProposals, AMarkerIsFirstChoiceOnce)
{
    // Both of the first scan lie near m3; the one that fits better has it.
    const auto proposals =
        proposePairs({marker("m1", "s1", 500), marker("m2", "s1", 508), marker("m3", "s2", 550)}, {match()});
    ASSERT_EQ(proposals.size(), 2U);
    EXPECT_EQ(proposals[0].first, "m1");
    EXPECT_EQ(proposals[0].rank, 1);
    EXPECT_GT(proposals[1].rank, 1);
}

TEST(PairProposals, OtherSizesSpeakAgainst)
{
    EXPECT_TRUE(proposePairs({marker("m1", "s1", 500, 5), marker("m2", "s2", 550, 15)}, {match()}).empty());
}

TEST(PairProposals, NeedMarkersOfNoPairInTwoScans)
{
    Marker paired = marker("m2", "s2", 552), partner = marker("m9", "s1", 900);
    paired.partners = {"m9"};
    partner.partners = {"m2"};
    EXPECT_TRUE(mayBePaired({marker("m1", "s1", 500), marker("m2", "s2", 552)}));
    EXPECT_FALSE(mayBePaired({marker("m1", "s1", 500), paired, partner}));
    EXPECT_FALSE(mayBePaired({marker("m1", "s1", 500), marker("m2", "s1", 552)}));
    EXPECT_FALSE(mayBePaired({}));
}

TEST(PairProposals, AMarkerInAnIntervalNarrowerThanItselfIsWithin)
{
    ScanMatch narrow = match();
    for (StationInterval& place : narrow.map.to) {
        place.least_mm = place.station_mm - 1;
        place.most_mm = place.station_mm + 1;
    }
    EXPECT_TRUE(proposePairs({marker("m1", "s1", 500), marker("m2", "s2", 553)}, {narrow}).at(0).within);
    EXPECT_FALSE(proposePairs({marker("m1", "s1", 500), marker("m2", "s2", 556)}, {narrow}).at(0).within);
}

TEST(PairProposals, PairedMarkersAndThoseOfOneScanAreLeftAlone)
{
    Marker paired = marker("m2", "s2", 550), partner = marker("m9", "s1", 900);
    paired.partners = {"m9"};
    partner.partners = {"m2"};
    EXPECT_TRUE(proposePairs({marker("m1", "s1", 500), paired, marker("m3", "s1", 500), partner}, {match()}).empty());
}

/// Three scans of one colon: each lies 50 mm on from the one before.
std::vector<ScanMatch> matchesOfThree()
{
    ScanMatch first = match(), second = match(), across = match();
    second.from_scan = "s2";
    second.to_scan = across.to_scan = "s3";
    for (StationInterval& place : across.map.to) {
        place.station_mm += 50;
        place.least_mm += 50;
        place.most_mm += 50;
    }
    return {first, across, second};
}

TEST(PairProposals, APairIsProposedWithTheThirdScansSightOfItAndTheThreeAreOneGroup)
{
    std::vector<Marker> markers{marker("m1", "s1", 500), marker("m2", "s2", 550), marker("m3", "s3", 600)};
    EXPECT_EQ(proposePairs(markers, matchesOfThree()).size(), 3U);
    const auto take = [&](const std::vector<MarkerEdit>& edits) {
        for (const MarkerEdit& edit : edits)
            for (Marker& marker : markers)
                if (marker.id == edit.after->id)
                    marker = *edit.after;
    };
    take(pairingEdits(markers, markers[0], markers[1]));
    EXPECT_EQ(partnerNames(markers[0]), "m2");
    const auto proposals = proposePairs(markers, matchesOfThree());
    ASSERT_EQ(proposals.size(), 2U) << "the third, with either";
    for (const PairProposal& proposal : proposals) {
        EXPECT_EQ(proposal.second, "m3");
        EXPECT_EQ(proposal.rank, 1);
        EXPECT_THAT(proposal.reason, HasSubstr(proposal.first == "m1" ? "m1 is paired with m2" : "m2 is pai"));
    }
    EXPECT_TRUE(mayBePaired(markers));
    take(pairingEdits(markers, markers[2], markers[1]));
    EXPECT_EQ(partnerNames(markers[0]), "m2, m3") << "each names all others, whichever was confirmed";
    EXPECT_EQ(partnerNames(markers[1]), "m1, m3");
    EXPECT_EQ(partnerNames(markers[2]), "m1, m2");
    EXPECT_FALSE(mayBePaired(markers));
    EXPECT_TRUE(proposePairs(markers, matchesOfThree()).empty());
}

TEST(PairProposals, NeverHaveTwoMarkersOfOneScanInAGroup)
{
    std::vector<Marker> markers{marker("m1", "s1", 500), marker("m2", "s2", 550), marker("m3", "s3", 600),
                                marker("m4", "s2", 552)};
    markers[0].partners = {"m2"};
    markers[1].partners = {"m1"};
    markers[2].partners = {"m4"};
    markers[3].partners = {"m3"};
    EXPECT_FALSE(mayBeOneFinding(markers, markers[0], markers[2])) << "m2 and m4 lie in one scan";
    EXPECT_TRUE(proposePairs(markers, matchesOfThree()).empty());
    EXPECT_THROW(pairingEdits(markers, markers[0], markers[2]), Error);
    EXPECT_THROW(pairingEdits(markers, markers[1], markers[3]), Error);
    // Said by the reader all the same: the former partner gives way.
    const auto edits = pairingEdits(markers, markers[0], markers[3]);
    ASSERT_EQ(edits.size(), 3U);
    EXPECT_EQ(partnerNames(*edits[0].after), "m3, m4");
    EXPECT_EQ(edits[1].after->id, "m3") << "in the case's order";
    EXPECT_EQ(partnerNames(*edits[1].after), "m1, m4");
    EXPECT_EQ(partnerNames(*edits[2].after), "m1, m3");
    EXPECT_EQ(partnerNames(*edits[1].before), "m4") << "as it was stored";
}

}  // namespace
}  // namespace vicon

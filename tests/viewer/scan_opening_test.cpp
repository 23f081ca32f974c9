// The request to open a scan, from asking to arriving.
#include "vicon/viewer/model/scan_opening.h"

#include <gtest/gtest.h>

namespace vicon::viewer {
namespace {

constexpr const char *kSupine = "s1", *kProne = "s2";

ScanRequest requestFor(const char* scan_id)
{
    ScanRequest request;
    request.scan_id = scan_id;
    return request;
}

ScanRequest redone(const char* scan_id)
{
    ScanRequest request = requestFor(scan_id);
    request.read_again = request.redone = true;
    return request;
}

TEST(ScanOpening, TheFirstScanOfACaseIsReadOnWhereItWasLeft)
{
    ScanOpening opening;
    opening.ask(requestFor(kSupine), {});
    EXPECT_TRUE(opening.underWay());
    const Arrival arrival = opening.opened(kSupine);
    EXPECT_TRUE(std::holds_alternative<LastPlace>(arrival.place));
    EXPECT_FALSE(arrival.marker_id || arrival.place_markers || arrival.redone_by_other);
    EXPECT_FALSE(opening.underWay());
}

TEST(ScanOpening, AnotherScanIsReadOnAtTheCorrespondingPlace)
{
    ScanOpening opening;
    opening.ask(requestFor(kProne), ScanOpening::From{kSupine, 420});
    const Arrival arrival = opening.opened(kProne);
    ASSERT_TRUE(std::holds_alternative<CorrespondingPlace>(arrival.place));
    EXPECT_EQ(std::get<CorrespondingPlace>(arrival.place).station_mm, 420);
}

TEST(ScanOpening, TheSameScanIsReadOnWhereTheEyeWas)
{
    ScanOpening opening;
    opening.ask(redone(kSupine), ScanOpening::From{kSupine, 420});
    const Arrival arrival = opening.opened(kSupine);
    ASSERT_TRUE(std::holds_alternative<SamePlace>(arrival.place));
    EXPECT_FALSE(std::get<SamePlace>(arrival.place).point_mm);
}

TEST(ScanOpening, OnAnotherWayTheEyeGoesToThePointThatWasAskedFor)
{
    ScanOpening opening;
    ScanRequest request = requestFor(kSupine);
    request.read_again = true;
    request.go_to_mm = Point3{1, 2, 3};
    opening.ask(request, ScanOpening::From{kSupine, 420});
    const Arrival arrival = opening.opened(kSupine);
    ASSERT_TRUE(std::get<SamePlace>(arrival.place).point_mm);
    EXPECT_EQ(std::get<SamePlace>(arrival.place).point_mm->z, 3);
}

TEST(ScanOpening, AMarkerIsShownOnceItsScanIsOpen)
{
    ScanOpening opening;
    ScanRequest request = requestFor(kProne);
    request.marker_id = "m3";
    opening.ask(request, ScanOpening::From{kSupine, 0});
    EXPECT_EQ(opening.opened(kProne).marker_id, "m3");
    opening.ask(requestFor(kSupine), ScanOpening::From{kProne, 0});
    EXPECT_FALSE(opening.opened(kSupine).marker_id) << "once";
}

TEST(ScanOpening, WhatIsAskedForLaterReplacesWhatWasUnderWay)
{
    ScanOpening opening;
    ScanRequest to_marker = requestFor(kProne);
    to_marker.marker_id = "m3";
    opening.ask(to_marker, ScanOpening::From{kSupine, 100});
    opening.ask(requestFor(kProne), ScanOpening::From{kSupine, 200});
    const Arrival arrival = opening.opened(kProne);
    EXPECT_FALSE(arrival.marker_id);
    EXPECT_EQ(std::get<CorrespondingPlace>(arrival.place).station_mm, 200);
}

TEST(ScanOpening, WhatWasGivenUpLeavesNoRequest)
{
    ScanOpening opening;
    ScanRequest request = requestFor(kProne);
    request.marker_id = "m3";
    request.go_to_mm = Point3{1, 2, 3};
    opening.ask(request, ScanOpening::From{kSupine, 100});
    opening.giveUp();
    EXPECT_FALSE(opening.underWay());
    opening.ask(requestFor(kProne), ScanOpening::From{kSupine, 300});
    const Arrival arrival = opening.opened(kProne);
    EXPECT_FALSE(arrival.marker_id);
    EXPECT_EQ(std::get<CorrespondingPlace>(arrival.place).station_mm, 300);
}

TEST(ScanOpening, AScanThatWasDoneAgainHasItsMarkersPlacedAnewOnce)
{
    ScanOpening opening;
    opening.ask(redone(kSupine), ScanOpening::From{kSupine, 0});
    const Arrival arrival = opening.opened(kSupine);
    EXPECT_TRUE(arrival.place_markers);
    EXPECT_FALSE(arrival.redone_by_other) << "the reader did it";
    opening.ask(requestFor(kProne), ScanOpening::From{kSupine, 0});
    EXPECT_FALSE(opening.opened(kProne).place_markers);
}

TEST(ScanOpening, MarkersAreStillPlacedAnewWhereTheScanWasNotOpenedAfterAll)
{
    for (const bool given_up : {true, false}) {
        ScanOpening opening;
        opening.ask(redone(kSupine), ScanOpening::From{kSupine, 0});
        if (given_up)
            opening.giveUp();
        opening.ask(requestFor(kProne), ScanOpening::From{kSupine, 0});
        EXPECT_TRUE(opening.opened(kProne).place_markers) << given_up;
    }
}

ScanObserved observed(bool in_work, bool readable, bool made_anew)
{
    return {kSupine, in_work, readable, made_anew, false};
}

TEST(ScanOpening, AScanDoneAgainForAnotherReaderIsAskedForAndSaidToBe)
{
    ScanOpening opening;
    EXPECT_FALSE(opening.observed(observed(false, true, false)));
    EXPECT_FALSE(opening.observed(observed(true, false, false)));
    const auto request = opening.observed(observed(false, true, true));
    ASSERT_TRUE(request);
    EXPECT_EQ(request->scan_id, kSupine);
    EXPECT_TRUE(request->read_again);
    opening.ask(*request, ScanOpening::From{kSupine, 10});
    EXPECT_FALSE(opening.observed(observed(false, true, true))) << "asked for once";
    const Arrival arrival = opening.opened(kSupine);
    EXPECT_TRUE(arrival.redone_by_other);
    EXPECT_TRUE(arrival.place_markers);
}

TEST(ScanOpening, NothingIsAskedForWhereTheFilesAreTheSameOrCannotBeRead)
{
    for (const auto& [readable, made_anew] : {std::pair(true, false), std::pair(false, true)}) {
        ScanOpening opening;
        opening.observed(observed(true, false, false));
        EXPECT_FALSE(opening.observed(observed(false, readable, made_anew)));
    }
    ScanOpening opening;
    EXPECT_FALSE(opening.observed(observed(false, true, true))) << "it was never seen in work";
}

TEST(ScanOpening, OwnWorkIsNotAnotherReaders)
{
    ScanOpening opening;
    ScanObserved own = observed(true, false, false);
    own.own_work = true;
    EXPECT_FALSE(opening.observed(own));
    EXPECT_FALSE(opening.observed(observed(false, true, true)));
}

TEST(ScanOpening, ThatItWasAnotherReaderIsSaidOfThatScanOnly)
{
    ScanRequest by_other = redone(kSupine);
    by_other.redone_by_other = true;
    ScanOpening opening;
    opening.ask(by_other, ScanOpening::From{kSupine, 0});
    opening.ask(requestFor(kProne), ScanOpening::From{kSupine, 0});
    EXPECT_FALSE(opening.opened(kProne).redone_by_other);
    opening.ask(by_other, ScanOpening::From{kProne, 0});
    opening.ask(requestFor(kSupine), ScanOpening::From{kProne, 0});
    EXPECT_TRUE(opening.opened(kSupine).redone_by_other);
}

}  // namespace
}  // namespace vicon::viewer

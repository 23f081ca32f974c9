// What the reader's next click is for: every tool against every event.
#include "vicon/viewer/model/interaction.h"

#include <gtest/gtest.h>

namespace vicon::viewer {
namespace {

constexpr const char *kRead = "s1", *kBeside = "s2";

PickedPoint pointAt(double x_mm)
{
    PickedPoint point;
    point.at_mm = {x_mm, 0, 0};
    point.scan_id = kRead;
    return point;
}

PickedPoint onWall(double x_mm)
{
    PickedPoint point = pointAt(x_mm);
    point.on_wall = true;
    return point;
}

PickedPoint withShift()
{
    PickedPoint point = pointAt(0);
    point.wants_marker = true;
    return point;
}

PickedPoint beside()
{
    PickedPoint point = pointAt(0);
    point.scan_id = kBeside;
    return point;
}

Marker markerIn(const char* scan_id, const char* id)
{
    Marker marker;
    marker.id = id;
    marker.scan_id = scan_id;
    return marker;
}

std::vector<ToolInUse> allTools()
{
    return {Idle{},
            PlaceMarker{MarkerColor::green},
            MoveMarker{"m1", kRead},
            PairMarker{"m1", kRead},
            Correct{Correction::cut},
            Measure{{{1, 2, 3}}, true},
            CircleFinding{}};
}

template <class T, class Variant>
bool is(const Variant& variant)
{
    return std::holds_alternative<T>(variant);
}

TEST(Interaction, BeginsWithNothingInUseAndAClickShowsThePoint)
{
    Interaction interaction;
    EXPECT_TRUE(interaction.inUse<Idle>());
    EXPECT_FALSE(interaction.awaitsClick());
    EXPECT_TRUE(is<ShowPoint>(interaction.click(pointAt(1))));
    EXPECT_TRUE(interaction.inUse<Idle>());
}

TEST(Interaction, EscapeAndFinishEndEveryTool)
{
    for (const ToolInUse& tool : allTools()) {
        Interaction interaction;
        interaction.begin(tool);
        interaction.escape();
        EXPECT_TRUE(interaction.inUse<Idle>()) << tool.index();
        interaction.begin(tool);
        interaction.finish();
        EXPECT_TRUE(interaction.inUse<Idle>()) << tool.index();
    }
}

TEST(Interaction, TheToolChosenLastIsInUseWhateverWasBefore)
{
    for (const ToolInUse& before : allTools())
        for (const ToolInUse& after : allTools()) {
            Interaction interaction;
            interaction.begin(before);
            interaction.begin(after);
            EXPECT_EQ(interaction.tool().index(), after.index());
        }
}

TEST(Interaction, AllButPairingAwaitAClickInAPicture)
{
    for (const ToolInUse& tool : allTools()) {
        Interaction interaction;
        interaction.begin(tool);
        EXPECT_EQ(interaction.awaitsClick(), !is<Idle>(tool) && !is<PairMarker>(tool)) << tool.index();
    }
}

TEST(Interaction, AMarkerIsPlacedOnceInTheColourThatWasChosen)
{
    Interaction interaction;
    interaction.begin(PlaceMarker{MarkerColor::yellow});
    const ClickMeaning first = interaction.click(pointAt(1));
    ASSERT_TRUE(is<AddMarker>(first));
    EXPECT_EQ(std::get<AddMarker>(first).color, MarkerColor::yellow);
    EXPECT_TRUE(is<ShowPoint>(interaction.click(pointAt(1))));
}

TEST(Interaction, ShiftPlacesARedMarkerAlsoInTheScanBeside)
{
    Interaction interaction;
    PickedPoint point = beside();
    point.wants_marker = true;
    for (const PickedPoint& clicked : {withShift(), point}) {
        const ClickMeaning meaning = interaction.click(clicked);
        ASSERT_TRUE(is<AddMarker>(meaning));
        EXPECT_EQ(std::get<AddMarker>(meaning).color, MarkerColor::red);
    }
}

TEST(Interaction, ShiftChangesNothingWhereAToolAwaitsTheClick)
{
    Interaction interaction;
    interaction.begin(PlaceMarker{MarkerColor::green});
    EXPECT_EQ(std::get<AddMarker>(interaction.click(withShift())).color, MarkerColor::green);
    interaction.begin(MoveMarker{"m1", kRead});
    EXPECT_TRUE(is<MoveMarkerHere>(interaction.click(withShift())));
    interaction.begin(Measure{});
    EXPECT_TRUE(is<AwaitOtherEnd>(interaction.click(withShift())));
    interaction.begin(Correct{Correction::add});
    EXPECT_TRUE(is<CorrectHere>(interaction.click(withShift())));
}

TEST(Interaction, WhilePairingOrCirclingAClickShowsThePointAndTheToolStays)
{
    for (const ToolInUse& tool : {ToolInUse(PairMarker{"m1", kRead}), ToolInUse(CircleFinding{})}) {
        Interaction interaction;
        interaction.begin(tool);
        EXPECT_TRUE(is<ShowPoint>(interaction.click(pointAt(1))));
        EXPECT_EQ(interaction.tool().index(), tool.index());
        EXPECT_TRUE(is<AddMarker>(interaction.click(withShift())));
        EXPECT_TRUE(interaction.inUse<Idle>());
    }
}

TEST(Interaction, AMarkerIsMovedWithinItsScanOnly)
{
    Interaction interaction;
    interaction.begin(MoveMarker{"m7", kRead});
    const ClickMeaning moved = interaction.click(pointAt(1));
    ASSERT_TRUE(is<MoveMarkerHere>(moved));
    EXPECT_EQ(std::get<MoveMarkerHere>(moved).id, "m7");
    EXPECT_TRUE(interaction.inUse<Idle>());

    interaction.begin(MoveMarker{"m7", kRead});
    const ClickMeaning refused = interaction.click(beside());
    ASSERT_TRUE(is<Refuse>(refused));
    EXPECT_EQ(std::get<Refuse>(refused).why, Refuse::Why::marker_of_other_scan);
    EXPECT_EQ(std::get<Refuse>(refused).marker_id, "m7");
    EXPECT_TRUE(interaction.inUse<Idle>());
}

TEST(Interaction, ACorrectionIsInUseUntilAPointWasAccepted)
{
    Interaction interaction;
    interaction.begin(Correct{Correction::drop});
    for (int refused = 0; refused < 2; ++refused) {
        const ClickMeaning meaning = interaction.click(pointAt(1));
        ASSERT_TRUE(is<CorrectHere>(meaning));
        EXPECT_EQ(std::get<CorrectHere>(meaning).kind, Correction::drop);
    }
    interaction.finish();
    EXPECT_TRUE(is<ShowPoint>(interaction.click(pointAt(1))));
}

TEST(Interaction, ASizeLiesBetweenTwoClicks)
{
    Interaction interaction;
    interaction.begin(Measure{});
    EXPECT_TRUE(is<AwaitOtherEnd>(interaction.click(onWall(1))));
    EXPECT_TRUE(interaction.awaitsClick());
    const ClickMeaning size = interaction.click(onWall(9));
    ASSERT_TRUE(is<MeasureBetween>(size));
    EXPECT_EQ(std::get<MeasureBetween>(size).from_mm.x, 1);
    EXPECT_EQ(std::get<MeasureBetween>(size).to_mm.x, 9);
    EXPECT_TRUE(std::get<MeasureBetween>(size).on_wall);
    EXPECT_TRUE(interaction.inUse<Idle>());
}

TEST(Interaction, AnEndAtThePlaceOfTheFirstIsRefusedAndTheOtherOneStillAwaited)
{
    Interaction interaction;
    interaction.begin(Measure{});
    PickedPoint first = onWall(1), same = pointAt(1.6), other = onWall(1.8);
    for (PickedPoint* point : {&first, &same, &other})
        point->voxel_mm = 0.7;
    EXPECT_TRUE(is<AwaitOtherEnd>(interaction.click(first)));
    for (const PickedPoint& again : {first, same}) {
        const ClickMeaning refused = interaction.click(again);
        ASSERT_TRUE(is<Refuse>(refused));
        EXPECT_EQ(std::get<Refuse>(refused).why, Refuse::Why::end_in_same_place);
    }
    const ClickMeaning size = interaction.click(other);
    ASSERT_TRUE(is<MeasureBetween>(size));
    EXPECT_EQ(std::get<MeasureBetween>(size).from_mm.x, 1);
    EXPECT_EQ(std::get<MeasureBetween>(size).to_mm.x, 1.8);
    EXPECT_TRUE(std::get<MeasureBetween>(size).on_wall) << "the refused one does not count";
}

TEST(Interaction, OneClickOutlinesAPolypOfTheScanThatIsReadOrOfTheOneBeside)
{
    for (const PickedPoint& point : {onWall(1), beside()}) {
        Interaction interaction;
        interaction.begin(OutlinePolyp{});
        EXPECT_TRUE(interaction.awaitsClick());
        EXPECT_TRUE(is<OutlineHere>(interaction.click(point)));
        EXPECT_TRUE(interaction.inUse<Idle>());
    }
}

TEST(Interaction, ASizeWithAnEndInASliceIsNotMeasuredOverTheWall)
{
    for (const auto& [first, second] : {std::pair(pointAt(1), onWall(9)), std::pair(onWall(1), pointAt(9))}) {
        Interaction interaction;
        interaction.begin(Measure{});
        interaction.click(first);
        EXPECT_FALSE(std::get<MeasureBetween>(interaction.click(second)).on_wall);
    }
}

TEST(Interaction, AnEndInAnotherScanThanTheFirstIsRefusedAndTheFirstOneKept)
{
    Interaction interaction;
    interaction.begin(Measure{});
    interaction.click(onWall(1));
    const ClickMeaning refused = interaction.click(beside());
    ASSERT_TRUE(is<Refuse>(refused));
    EXPECT_EQ(std::get<Refuse>(refused).why, Refuse::Why::end_in_other_scan);
    EXPECT_TRUE(is<MeasureBetween>(interaction.click(onWall(9))));
}

TEST(Interaction, ASizeMayLieInTheScanBesideAndThenHasBothEndsThere)
{
    Interaction interaction;
    interaction.begin(Measure{});
    EXPECT_TRUE(is<AwaitOtherEnd>(interaction.click(beside())));
    EXPECT_TRUE(is<Refuse>(interaction.click(pointAt(9)))) << "the scan that is read is the other one now";
    const ClickMeaning size = interaction.click(beside());
    ASSERT_TRUE(is<MeasureBetween>(size));
    EXPECT_TRUE(interaction.inUse<Idle>());
}

TEST(Interaction, NoSizeReachesFromOneScanToAnother)
{
    Interaction interaction;
    interaction.begin(Measure{});
    interaction.click(onWall(1));
    interaction.scanChanged();
    EXPECT_TRUE(is<AwaitOtherEnd>(interaction.click(onWall(9)))) << "the end in the scan before is forgotten";
    EXPECT_TRUE(is<MeasureBetween>(interaction.click(onWall(10))));
}

TEST(Interaction, AnotherScanLeavesEveryToolInUse)
{
    for (const ToolInUse& tool : allTools()) {
        Interaction interaction;
        interaction.begin(tool);
        interaction.scanChanged();
        EXPECT_EQ(interaction.tool().index(), tool.index());
    }
}

TEST(Interaction, AChosenMarkerIsShownOrBecomesThePartner)
{
    Interaction interaction;
    EXPECT_TRUE(is<ShowMarker>(interaction.choose(markerIn(kRead, "m2"))));
    interaction.begin(PairMarker{"m1", kRead});
    const ChoiceMeaning pair = interaction.choose(markerIn(kBeside, "m2"));
    ASSERT_TRUE(is<PairWith>(pair));
    EXPECT_EQ(std::get<PairWith>(pair).id, "m1");
    EXPECT_TRUE(is<ShowMarker>(interaction.choose(markerIn(kBeside, "m2"))));
}

TEST(Interaction, TwoMarkersOfOneScanAreNoPair)
{
    Interaction interaction;
    interaction.begin(PairMarker{"m1", kRead});
    EXPECT_TRUE(is<RefusePair>(interaction.choose(markerIn(kRead, "m2"))));
    EXPECT_TRUE(interaction.inUse<Idle>());
}

TEST(Interaction, ChoosingAMarkerEndsNoToolButPairing)
{
    for (const ToolInUse& tool : allTools()) {
        Interaction interaction;
        interaction.begin(tool);
        interaction.choose(markerIn(kBeside, "m2"));
        EXPECT_EQ(interaction.tool().index(), is<PairMarker>(tool) ? ToolInUse(Idle{}).index() : tool.index());
    }
}

TEST(Interaction, AToolForAMarkerEndsWithTheMarkerAndNoOtherDoes)
{
    for (const ToolInUse& tool : allTools()) {
        const bool of_marker = is<MoveMarker>(tool) || is<PairMarker>(tool);
        Interaction interaction;
        interaction.begin(tool);
        interaction.markersChanged({markerIn(kRead, "m1"), markerIn(kRead, "m2")});
        EXPECT_EQ(interaction.tool().index(), tool.index());
        interaction.markersChanged({markerIn(kRead, "m2")});
        EXPECT_EQ(interaction.tool().index(), of_marker ? ToolInUse(Idle{}).index() : tool.index());
    }
}

}  // namespace
}  // namespace vicon::viewer

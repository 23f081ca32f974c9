#include "vicon/viewer/model/marker_history.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "vicon/core/error.h"
#include "vicon/support/support.h"

namespace vicon::viewer {
namespace {

struct History : testing::Test {
    support::TemporaryFolder folder;
    CaseStore store{folder / "store"};
    MarkerHistory history{"c1"};

    History()
    {
        CaseRecord a_case;
        a_case.id = "c1";
        a_case.study.uid = "1.2.3";
        for (const std::string id : {"s1", "s2", "s3"}) {
            ScanRecord scan;
            scan.id = id;
            scan.case_id = "c1";
            scan.series.uid = "1.2.3." + id;
            std::filesystem::create_directories(store.scanFolder("c1", id));
            store.addScan(a_case, scan, {}, false);
        }
    }
    Marker aMarker() const
    {
        Marker marker;
        marker.scan_id = "s1";
        marker.note = "first";
        return marker;
    }
    std::vector<std::string> notes()
    {
        std::vector<std::string> all;
        for (const Marker& m : store.markers("c1"))
            all.push_back(m.note);
        return all;
    }
    using Notes = std::vector<std::string>;
};

TEST_F(History, UndoesAndRedoesAddChangeAndRemoveInOrder)
{
    const Marker added = history.add(store, aMarker());
    Marker wanted = added;
    wanted.note = "second";
    const Marker changed = history.change(store, added, wanted);
    history.remove(store, changed);
    EXPECT_EQ(notes(), Notes{});
    for (const Notes& expected : {Notes{"second"}, Notes{"first"}, Notes{}}) {
        EXPECT_TRUE(history.canUndo());
        history.undo(store);
        EXPECT_EQ(notes(), expected);
    }
    EXPECT_FALSE(history.canUndo());
    history.undo(store);
    for (const Notes& expected : {Notes{"first"}, Notes{"second"}, Notes{}}) {
        EXPECT_TRUE(history.canRedo());
        history.redo(store);
        EXPECT_EQ(notes(), expected);
    }
    EXPECT_FALSE(history.canRedo());
}

TEST_F(History, ANewChangeForgetsWhatWasUndone)
{
    const Marker added = history.add(store, aMarker());
    history.undo(store);
    Marker other = aMarker();
    other.note = "other";
    history.add(store, other);
    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(notes(), Notes{"other"});
}

TEST_F(History, NeverOverwritesWhatAnotherReaderDid)
{
    const Marker added = history.add(store, aMarker());
    Marker theirs = added;
    theirs.note = "theirs";
    store.saveMarker("c1", theirs);
    Marker ours = added;
    ours.note = "ours";
    EXPECT_THROW(history.change(store, added, ours), Error);
    EXPECT_THROW(history.remove(store, added), Error);
    EXPECT_THROW(history.undo(store), Error);
    EXPECT_EQ(notes(), Notes{"theirs"});
    store.removeMarker("c1", added.id);
    EXPECT_THROW(history.change(store, added, ours), Error);
    EXPECT_EQ(notes(), Notes{}) << "what they deleted does not come back";
}

TEST_F(History, WhatElseWasChangedMeanwhileStays)
{
    const Marker added = history.add(store, aMarker());
    Marker measured = added, noted = added;
    measured.size = MarkerSize{.straight_mm = 6, .from_mm = {1, 2, 3}, .to_mm = {1, 2, 9}};
    noted.note = "sessile";
    history.change(store, added, measured);
    const Marker both = history.change(store, added, noted);
    EXPECT_EQ(both.note, "sessile");
    EXPECT_EQ(both.size.value().straight_mm, 6);
    history.undo(store);
    EXPECT_EQ(notes(), Notes{"first"});
    EXPECT_TRUE(store.requireMarker("c1", added.id).size);
    history.undo(store);
    EXPECT_FALSE(store.requireMarker("c1", added.id).size);
}

TEST_F(History, ASizeIsNotKeptWithAMarkerThatLiesElsewhereByNow)
{
    const Marker added = history.add(store, aMarker());
    Marker moved = added, measured = added;
    moved.position_mm = {100, 0, 0};
    history.change(store, added, moved);
    measured.size = MarkerSize{};
    EXPECT_THROW(history.change(store, added, measured), Error);
    EXPECT_FALSE(store.requireMarker("c1", added.id).size);
}

/// Two markers of one finding and a third one in the second scan.
struct Pairs : History {
    Marker a = add("a", "s1"), b = add("b", "s2"), c = add("c", "s2");

    Marker add(const std::string& note, const std::string& scan_id)
    {
        Marker marker = aMarker();
        marker.scan_id = scan_id;
        marker.note = note;
        return history.add(store, marker);
    }
    Marker now(const Marker& marker) { return store.requireMarker("c1", marker.id); }
    /// "ab": a's partner is b; in the order of the notes.
    std::vector<std::string> pairs()
    {
        std::vector<std::string> all;
        for (const Marker& m : store.markers("c1"))
            all.push_back(m.note + (m.partners.empty() ? "" : store.requireMarker("c1", m.partners.front()).note));
        std::sort(all.begin(), all.end());
        return all;
    }
    const Notes apart{"a", "b", "c"}, together{"ab", "ba", "c"};
};

TEST_F(Pairs, ArePairedPartedAndDeletedAsOneStepEach)
{
    history.pair(store, a, b);
    EXPECT_EQ(pairs(), together);
    history.part(store, now(b));
    EXPECT_EQ(pairs(), apart);
    history.undo(store);
    EXPECT_EQ(pairs(), together);
    history.undo(store);
    EXPECT_EQ(pairs(), apart);
    history.redo(store);
    history.remove(store, now(a));
    EXPECT_EQ(pairs(), (Notes{"b", "c"}));
    history.undo(store);
    EXPECT_EQ(pairs(), together);
    history.redo(store);
    EXPECT_EQ(pairs(), (Notes{"b", "c"}));
    history.undo(store);
    history.undo(store);
    EXPECT_EQ(pairs(), apart);
}

TEST_F(Pairs, ReleaseTheFormerPartner)
{
    history.pair(store, a, b);
    history.pair(store, now(a), c);
    EXPECT_EQ(pairs(), (Notes{"ac", "b", "ca"}));
    history.undo(store);
    EXPECT_EQ(pairs(), together);
    history.redo(store);
    EXPECT_EQ(pairs(), (Notes{"ac", "b", "ca"}));
}

TEST_F(Pairs, AreNeverHalfWhenTheOtherMarkerWasChangedMeanwhile)
{
    Marker theirs = b;
    theirs.note = "B";
    store.saveMarker("c1", theirs);
    EXPECT_THROW(history.pair(store, a, b), Error);
    EXPECT_EQ(pairs(), (Notes{"B", "a", "c"}));
    history.pair(store, a, theirs);
    theirs = now(theirs);
    theirs.note = "b";
    store.saveMarker("c1", theirs);
    EXPECT_THROW(history.undo(store), Error);
    EXPECT_EQ(pairs(), together) << "what could not be undone is in force as a whole";
    EXPECT_TRUE(history.canUndo());
    EXPECT_FALSE(history.canRedo());
}

TEST_F(Pairs, GrowToAGroupOfThreeScansWhichLosesOneAndIsUndone)
{
    const Marker third = add("d", "s3");
    const auto partners = [&](const Marker& marker) {
        std::string notes;
        for (const std::string& id : now(marker).partners)
            notes += store.requireMarker("c1", id).note;
        return notes;
    };
    history.pair(store, a, b);
    history.pair(store, third, now(b));
    EXPECT_EQ(partners(a), "bd");
    EXPECT_EQ(partners(b), "ad");
    EXPECT_EQ(partners(third), "ab");
    history.part(store, now(b));
    EXPECT_EQ(partners(a), "d") << "the others stay together";
    EXPECT_EQ(partners(b), "");
    EXPECT_EQ(partners(third), "a");
    history.undo(store);
    EXPECT_EQ(partners(third), "ab");
    history.pair(store, now(a), c);  // c lies in b's scan
    EXPECT_EQ(partners(a), "cd");
    EXPECT_EQ(partners(b), "");
    EXPECT_EQ(partners(c), "ad");
    EXPECT_EQ(partners(third), "ac");
    history.undo(store);
    history.remove(store, now(a));
    EXPECT_EQ(partners(b), "d");
    history.undo(store);
    EXPECT_EQ(partners(b), "ad");
    history.undo(store);
    history.undo(store);
    EXPECT_EQ(partners(third) + partners(a) + partners(b), "");
}

TEST_F(Pairs, OfOneScanAreRefused)
{
    EXPECT_THROW(history.pair(store, b, c), Error);
    EXPECT_EQ(pairs(), apart);
}

TEST_F(History, AChangeThatFailsIsNotUndone)
{
    const Marker added = history.add(store, aMarker());
    Marker theirs = added;
    theirs.note = "theirs";
    store.saveMarker("c1", theirs);
    EXPECT_THROW(history.remove(store, added), Error);
    store.saveMarker("c1", added);
    history.undo(store);
    EXPECT_EQ(notes(), Notes{}) << "the adding, not the failed deletion";
    EXPECT_FALSE(history.canUndo());
}

TEST_F(History, SavesOnceThoughTheFileOfMarkersCannotBeWritten)
{
    const auto file = store.caseFolder("c1") / "markers.json";
    std::filesystem::create_directories(file / "in the way");
    history.add(store, aMarker());
    EXPECT_NE(store.markerFileTrouble(), "");
    EXPECT_EQ(notes(), Notes{"first"});
    EXPECT_TRUE(history.canUndo());
    history.undo(store);
    EXPECT_EQ(notes(), Notes{});
}

}  // namespace
}  // namespace vicon::viewer

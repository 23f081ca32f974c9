#include "vicon/viewer/model/marker_history.h"

#include <gtest/gtest.h>

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
        ScanRecord scan;
        scan.id = "s1";
        scan.case_id = "c1";
        scan.series.uid = "1.2.3.1";
        std::filesystem::create_directories(store.scanFolder("c1", "s1"));
        store.addScan(a_case, scan, {}, false);
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

}  // namespace
}  // namespace vicon::viewer

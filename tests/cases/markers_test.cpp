#include <gmock/gmock.h>
#include <soci/soci.h>

#include <thread>

#include "vicon/cases/case_store.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/store_place.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;

class Markers : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    CaseStore store_{support::storePlace(folder_.path())};

    Markers()
    {
        CaseRecord a_case;
        a_case.id = "c1";
        a_case.study.uid = "1.2";
        for (const std::string id : {"s1", "s2"}) {
            fs::create_directories(store_.scanFolder("c1", id));
            ScanRecord scan;
            scan.id = id;
            scan.case_id = "c1";
            scan.series.uid = "1.2." + id;
            store_.addScan(a_case, scan, {}, false);
        }
    }
    Marker saved(const std::string& scan_id, const std::string& note, const std::string& pair = {})
    {
        Marker marker{.scan_id = scan_id, .note = note};
        if (!pair.empty())
            marker.partners = {pair};
        return store_.saveMarker("c1", marker);
    }
    static Marker with(Marker marker, const std::string& note)
    {
        marker.note = note;
        return marker;
    }
    static Marker paired(Marker marker, const std::string& partner)
    {
        marker.partners = {partner};
        return marker;
    }
    /// "id note pair" of every marker.
    std::vector<std::string> all()
    {
        std::vector<std::string> out;
        for (const Marker& m : store_.markers("c1"))
            out.push_back(m.id + " " + m.note + " " + partnerNames(m));
        return out;
    }
    std::size_t inFile() const
    {
        return nlohmann::json::parse(readFile(store_.caseFolder("c1") / "markers.json"))["markers"].size();
    }
    /// Puts a folder that is not empty where the file shall be: no rename replaces it, whoever asks.
    fs::path blockFile() const
    {
        const fs::path file = store_.caseFolder("c1") / "markers.json";
        fs::remove(file);
        fs::create_directories(file / "in the way");
        return file;
    }
};

TEST_F(Markers, AreChangedOnlyWhileTheyAreWhatTheReaderSaw)
{
    const Marker seen = saved("s1", "seen");
    store_.saveMarker("c1", with(seen, "theirs"));
    EXPECT_THROW(store_.editMarkers("c1", {{seen, with(seen, "ours")}}), Error);
    EXPECT_THROW(store_.editMarkers("c1", {{seen, std::nullopt}}), Error);
    EXPECT_THROW(store_.editMarkers("c1", {{std::nullopt, seen}}), Error) << "it is there, so it is not added again";
    EXPECT_THAT(all(), UnorderedElementsAre("m1 theirs "));
}

TEST_F(Markers, ComeBackUnderTheirOwnIdWhenADeletionIsUndone)
{
    const Marker seen = saved("s1", "seen");
    store_.editMarkers("c1", {{seen, std::nullopt}});
    EXPECT_THAT(all(), UnorderedElementsAre());
    store_.editMarkers("c1", {{std::nullopt, seen}});
    EXPECT_THAT(all(), UnorderedElementsAre("m1 seen "));
}

TEST_F(Markers, OfOneStepAreAllChangedOrNone)
{
    const Marker a = saved("s1", "a"), b = saved("s2", "b");
    store_.saveMarker("c1", with(b, "theirs"));
    EXPECT_THROW(store_.editMarkers("c1", {{a, paired(a, b.id)}, {b, paired(b, a.id)}}), Error);
    EXPECT_THROW(store_.editMarkers("c1", {{std::nullopt, Marker{.scan_id = "s1"}}, {b, std::nullopt}}), Error);
    EXPECT_THAT(all(), UnorderedElementsAre("m1 a ", "m2 theirs "));
    EXPECT_EQ(saved("s1", "c").id, "m3") << "what was rolled back took no number";
}

TEST_F(Markers, ArePartedOnBothSidesByWhateverEndsAPair)
{
    const struct {
        const char* what;
        std::function<void(CaseStore&, const Marker& a, const Marker& b)> end;
        std::vector<std::string> expected;
    } cases[] = {
        {"deleted",
         [](CaseStore& s, const Marker& a, const Marker&) {
             s.editMarkers("c1", {{a, std::nullopt}});
         },
         {"m2 b ", "m3 c "}},
        {"removed",
         [](CaseStore& s, const Marker& a, const Marker&) { s.removeMarker("c1", a.id); },
         {"m2 b ", "m3 c "}},
        {"parted",
         [](CaseStore& s, const Marker& a, const Marker&) {
             Marker after = a;
             after.partners.clear();
             s.editMarkers("c1", {{a, after}});
         },
         {"m1 a ", "m2 b ", "m3 c "}},
        {"paired with a third",
         [](CaseStore& s, const Marker& a, const Marker&) {
             const Marker c = s.requireMarker("c1", "m3");
             s.editMarkers("c1", {{a, paired(a, "m3")}, {c, paired(c, "m1")}});
         },
         {"m1 a m3", "m2 b ", "m3 c m1"}},
        {"only changed",
         [](CaseStore& s, const Marker& a, const Marker&) {
             s.editMarkers("c1", {{a, with(a, "A")}});
         },
         {"m1 A m2", "m2 b m1", "m3 c "}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.what);
        store_.database().write([](soci::session& sql) { sql << "DELETE FROM markers"; });
        store_.database().write([](soci::session& sql) { sql << "DELETE FROM counters"; });
        const Marker a = saved("s1", "a", "m2"), b = saved("s2", "b", "m1");
        saved("s2", "c");
        c.end(store_, a, b);
        EXPECT_THAT(all(), testing::UnorderedElementsAreArray(c.expected));
    }
}

TEST_F(Markers, WhosePairIsNotTextHaveNone)
{
    Marker marker{.scan_id = "s1"};
    marker.extra["pair"] = 7;
    const Marker saved = store_.saveMarker("c1", marker);
    EXPECT_TRUE(store_.requireMarker("c1", saved.id).partners.empty());
    EXPECT_EQ(store_.requireMarker("c1", saved.id).extra["pair"], 7);
}

TEST_F(Markers, OfADeletedCaseAreRefused)
{
    EXPECT_THROW(store_.editMarkers("c9", {{std::nullopt, Marker{.scan_id = "s1"}}}), Error);
    EXPECT_TRUE(store_.markers("c9").empty());
}

TEST_F(Markers, AreSavedOnceThoughTheirFileCannotBeWritten)
{
    const Marker first = saved("s1", "first");
    const fs::path file = blockFile();
    const Marker second = saved("s1", "second");
    EXPECT_THAT(store_.markerFileTrouble(), HasSubstr("markers.json"));
    store_.editMarkers("c1", {{first, with(first, "changed")}});
    EXPECT_NE(store_.markerFileTrouble(), "");
    store_.removeMarker("c1", second.id);
    EXPECT_THAT(all(), UnorderedElementsAre("m1 changed "));

    fs::remove_all(file);
    EXPECT_EQ(CaseStore(store_.place()).markerFileTrouble(), "");
    EXPECT_EQ(inFile(), 1u) << "opening the store writes what was owed";
}

TEST_F(Markers, FileIsWrittenByTheNextChangeWhenThePlaceCanBeWrittenAgain)
{
    const fs::path file = blockFile();
    saved("s1", "first");
    fs::remove_all(file);
    saved("s1", "second");
    EXPECT_EQ(store_.markerFileTrouble(), "");
    EXPECT_EQ(inFile(), 2u);
}

TEST_F(Markers, SqliteOnAFullDiskAreNotSavedAndThenSavedOnce)
{
    const Marker first = saved("s1", "first");
    // No further page, as on a full disk: SQLite's own answer to it.
    store_.database().session() << "PRAGMA max_page_count = 1";
    const std::string long_note(200'000, 'n');
    EXPECT_THROW(saved("s1", long_note), Error);
    EXPECT_THROW(store_.editMarkers("c1", {{first, with(first, "half")}, {std::nullopt, with({}, long_note)}}), Error);
    EXPECT_THAT(all(), UnorderedElementsAre("m1 first "));
    store_.database().session() << "PRAGMA max_page_count = 1000000";
    EXPECT_EQ(saved("s1", long_note).id, "m2");
    EXPECT_EQ(store_.markers("c1").size(), 2u);
    EXPECT_EQ(inFile(), 2u);
}

TEST_F(Markers, LoseNoChangeWhenTwoReadersRace)
{
    constexpr int kChanges = 15;  // of each reader
    const Marker start = saved("s1", "0");
    const auto read = [&] {
        CaseStore store(store_.place());
        for (int done = 0; done < kChanges;) {
            const Marker seen = store.requireMarker("c1", start.id);
            try {
                store.editMarkers("c1", {{seen, with(seen, std::to_string(std::stoi(seen.note) + 1))}});
                ++done;
            } catch (const Error& e) {
                ASSERT_EQ(e.code(), ErrorCode::bad_input) << e.what();  // the other one was faster
            }
        }
    };
    std::thread other(read);
    read();
    other.join();
    EXPECT_EQ(store_.requireMarker("c1", start.id).note, std::to_string(2 * kChanges));
    const auto file = nlohmann::json::parse(readFile(store_.caseFolder("c1") / "markers.json"));
    EXPECT_EQ(file["markers"][0]["note"], std::to_string(2 * kChanges)) << "the file is that of the last change";
}

}  // namespace
}  // namespace vicon

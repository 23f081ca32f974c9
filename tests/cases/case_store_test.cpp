#include "vicon/cases/case_store.h"

#include <gmock/gmock.h>
#include <soci/soci.h>

#include "vicon/cases/audit_trail.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/message_of.h"
#include "vicon/support/store_place.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

using support::messageOf;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Store : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    CaseStore store_{support::storePlace(folder_.path())};

    void addScan(const std::string& scan_id)
    {
        fs::create_directories(store_.scanFolder("c1", scan_id));
        CaseRecord a_case;
        a_case.id = "c1";
        a_case.patient = {"P1", "Doe^Jane", "19500101", "F"};
        a_case.study.uid = "1.2";
        ScanRecord scan;
        scan.id = scan_id;
        scan.case_id = "c1";
        scan.series.uid = "1.2." + scan_id;
        scan.series.patient_position = "HFP";
        store_.addScan(a_case, scan, {{"1.2.9." + scan_id, "c1", scan_id, "hash", "a.dcm"}}, true);
    }
};

TEST_F(Store, SaysWhetherAnybodyChangedAnything)
{
    addScan("s1");
    const std::string first = store_.database().version();
    store_.cases();
    EXPECT_EQ(store_.database().version(), first) << "nothing was changed";
    store_.audit(AuditEvent::case_opened, "c1", "s1", "");
    const std::string second = store_.database().version();
    EXPECT_NE(second, first) << "changed over this connection";
    CaseStore(store_.place()).audit(AuditEvent::case_opened, "c1", "s1", "");
    const std::string third = store_.database().version();
    EXPECT_NE(third, second) << "changed over another one";
    EXPECT_EQ(store_.database().version(), third);
}

TEST_F(Store, TellsARefusedStatementWithoutItsWordsAndValues)
{
    const std::string name = "Mustermann^Erika";
    const auto toldOf = [&](const std::string& statement) {
        const auto run = [&](soci::session& sql) { sql << statement, soci::use(name); };
        const std::string told = messageOf([&] { store_.database().write(run); });
        EXPECT_EQ(messageOf([&] { store_.database().read(run); }), told);
        EXPECT_THAT(told, AllOf(HasSubstr("the database refused ("), Not(HasSubstr("Mustermann")),
                                Not(HasSubstr("M-77")), Not(HasSubstr(":name")), Not(HasSubstr("VALUES"))));
        return told;
    };
    EXPECT_THAT(toldOf("INSERT INTO cases (id, study_uid, patient_id, patient_name, birth_date, sex, study, flags,"
                       " created) VALUES ('c9', NULL, 'M-77', :name, '', '', '{}', '[]', '')"),
                HasSubstr("study_uid"));
    EXPECT_THAT(toldOf("SELECT nothing FROM cases WHERE patient_name = :name"), HasSubstr("nothing"));
    if (support::usesPostgresql()) {
        EXPECT_THAT(toldOf("SELECT CAST(:name AS integer)"), HasSubstr("22P02"));
    }
}

TEST_F(Store, TellsARowThatCannotBeUnderstoodWithoutItsContent)
{
    addScan("s1");
    store_.database().write([](soci::session& sql) { sql << "UPDATE cases SET study = 'Mustermann'"; });
    EXPECT_THAT(messageOf([&] { store_.cases(); }),
                AllOf(HasSubstr("the database is damaged"), HasSubstr("vicon restore"), Not(HasSubstr("Muster"))));
}

TEST_F(Store, KeepsACaseItsScansAndTheirInstances)
{
    addScan("s1");
    addScan("s2");
    EXPECT_EQ(store_.requireCase("c1").patient.name, "Doe^Jane");
    EXPECT_EQ(store_.requireCase("c").id, "c1") << "a beginning is enough";
    EXPECT_EQ(store_.scans("c1").size(), 2u);
    EXPECT_EQ(store_.findInstance("1.2.9.s1")->scan_id, "s1");
    EXPECT_EQ(store_.findCaseByStudy("1.2")->id, "c1");
    EXPECT_THROW(store_.requireCase("x"), Error);
    EXPECT_THROW(store_.requireScan("c1", ""), Error) << "there are two";
}

TEST_F(Store, AddingTheSameAgainChangesNothing)
{
    addScan("s1");
    addScan("s1");
    EXPECT_EQ(store_.cases().size(), 1u);
    EXPECT_EQ(store_.scans("c1").size(), 1u);
    EXPECT_EQ(store_.instances("c1", "s1").size(), 1u);
}

TEST_F(Store, WritesScanJsonFromTheDatabase)
{
    addScan("s1");
    const auto json = nlohmann::json::parse(readFile(store_.scanFolder("c1", "s1") / "scan.json"));
    EXPECT_EQ(json["position"], "prone");
    EXPECT_EQ(json["patient"]["birth_date"], "19500101");
}

TEST_F(Store, NumbersMarkersAndNeverUsesANumberTwice)
{
    addScan("s1");
    const Marker first = store_.saveMarker("c1", {.scan_id = "s1", .note = "one"});
    EXPECT_EQ(first.id, "m1");
    store_.removeMarker("c1", "m1");
    EXPECT_EQ(store_.saveMarker("c1", {.scan_id = "s1"}).id, "m2");
    EXPECT_THROW(store_.removeMarker("c1", "m1"), Error);
}

TEST_F(Store, RewritesMarkersJsonAfterEveryChange)
{
    addScan("s1");
    addScan("s2");
    Marker marker = store_.saveMarker("c1", {.scan_id = "s1", .position_mm = {1, 2, 3}, .note = "polyp"});
    const auto markersIn = [](const fs::path& folder) {
        return nlohmann::json::parse(readFile(folder / "markers.json"))["markers"];
    };
    EXPECT_EQ(markersIn(store_.scanFolder("c1", "s1"))[0]["position_mm"], (nlohmann::json{1.0, 2.0, 3.0}));
    EXPECT_EQ(markersIn(store_.scanFolder("c1", "s2")).size(), 0u);
    EXPECT_EQ(markersIn(store_.caseFolder("c1")).size(), 1u);
    marker.note = "fold";
    store_.saveMarker("c1", marker);
    EXPECT_EQ(markersIn(store_.caseFolder("c1"))[0]["note"], "fold");
    store_.removeMarker("c1", marker.id);
    EXPECT_EQ(markersIn(store_.caseFolder("c1")).size(), 0u);
}

TEST_F(Store, FlagsACaseOncePerLine)
{
    addScan("s1");
    store_.flag("c1", "check the patient");
    store_.flag("c1", "check the patient");
    EXPECT_EQ(store_.requireCase("c1").flags, std::vector<std::string>{"check the patient"});
}

TEST_F(Store, ASettledFlagIsGoneAndStaysKnown)
{
    addScan("s1");
    store_.flag("c1", "check the patient");
    store_.flag("c1", "check the position");
    store_.settleFlag("c1", "check the patient");
    EXPECT_EQ(store_.requireCase("c1").flags, std::vector<std::string>{"check the position"}) << "no other";
    EXPECT_EQ(auditTrail(store_, "c1").back().event, "flag settled");
    EXPECT_EQ(auditTrail(store_, "c1").back().detail, "check the patient");
    EXPECT_TRUE(store_.wasFlagged("c1", "check the patient"));
    EXPECT_FALSE(store_.wasFlagged("c1", "check the dose"));
    EXPECT_FALSE(store_.wasFlagged("c2", "check the patient")) << "of another case";
    const std::size_t lines = auditTrail(store_, "c1").size();
    EXPECT_THAT(messageOf([&] { store_.settleFlag("c1", "check the patient"); }), HasSubstr("no such flag"));
    EXPECT_EQ(auditTrail(store_, "c1").size(), lines);
}

TEST_F(Store, BringsNoFlagBackThatAPersonTookAwayDuringAnImport)
{
    addScan("s1");
    store_.flag("c1", "check the patient");
    const CaseRecord before = store_.requireCase("c1");
    const ScanRecord scan = store_.scans("c1").at(0);
    store_.settleFlag("c1", "check the patient");
    store_.flag("c1", "of another");
    store_.addScan(before, scan, {}, false);
    EXPECT_EQ(store_.requireCase("c1").flags, std::vector<std::string>{"of another"});
}

TEST_F(Store, RefusesADatabaseOfANewerVersion)
{
    store_.database().session() << (support::usesPostgresql() ? "UPDATE store SET schema_version = 99"
                                                              : "PRAGMA user_version = 99");
    try {
        const CaseStore again(store_.place());
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::database);
        EXPECT_THAT(e.what(), HasSubstr("schema version 99"));
    }
}

TEST_F(Store, RollsBackAWriteThatThrows)
{
    addScan("s1");
    EXPECT_THROW(store_.database().write([](soci::session& sql) {
        sql << "DELETE FROM scans";
        throw Error(ErrorCode::internal, "stop");
    }),
                 Error);
    EXPECT_EQ(store_.scans("c1").size(), 1u);
}

TEST(StoreFolder, ThatCannotBeMadeIsOneClearLine)
{
    try {
        const CaseStore store("/proc/vicon-store");
        FAIL();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("/proc/vicon-store"));
    }
}

/// What a store without its database is told, and that none was made.
void expectLost(const fs::path& store)
{
    const auto database = [&] { return fs::exists(store / "vicon.db") ? readFile(store / "vicon.db") : "none"; };
    const std::string before = database();
    EXPECT_THAT(messageOf([&] { CaseStore{store}; }),
                AllOf(HasSubstr("its database is gone or empty"), HasSubstr("'vicon restore'")));
    EXPECT_TRUE(database() == before) << "it was made";
}

TEST(SqliteStore, WhoseDatabaseIsLostIsNotMadeAnew)
{
    for (const char* data : {"cases/c1", "reports/1.dcm", "quarantine/c1", "incoming/a", "deleted/c1-2"}) {
        SCOPED_TRACE(data);
        const support::TemporaryFolder folder;
        fs::create_directories(folder / data);
        expectLost(folder.path());
        replaceFile(folder / "vicon.db", "");
        expectLost(folder.path());
        ASSERT_EQ(support::runCommand("sqlite3 " + (folder / "vicon.db").string() + " VACUUM").exit_code, 0);
        EXPECT_THAT(messageOf([&] { CaseStore{folder.path()}; }), HasSubstr("its database is gone or empty"))
            << "without tables";
    }
    const support::TemporaryFolder begun;
    fs::create_directories(begun / "cases");
    replaceFile(begun / "vicon.db", "");
    EXPECT_NO_THROW(CaseStore{begun.path()}) << "a first start that was killed";
}

TEST(Ids, AreShortStableAndSafeAsPath)
{
    EXPECT_EQ(CaseStore::caseIdFor("1.2.3"), CaseStore::caseIdFor("1.2.3"));
    EXPECT_NE(CaseStore::caseIdFor("1.2.3"), CaseStore::caseIdFor("1.2.4"));
    EXPECT_THAT(CaseStore::caseIdFor("1.2.3"), testing::MatchesRegex("c[0-9a-f]+"));
}

}  // namespace
}  // namespace vicon

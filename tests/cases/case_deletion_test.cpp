// A case goes as a whole or not at all, and never while somebody works on it or something of it would be lost unasked.
#include "vicon/cases/case_deletion.h"

#include <gmock/gmock.h>
#include <soci/soci.h>

#include "case_tables.h"
#include "finding_fixture.h"
#include "this_person.h"
#include "vicon/cases/audit_trail.h"
#include "vicon/cases/kept_reports.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/purge.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"

namespace vicon {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class CaseDeletion : public testing::Test {
protected:
    test::MarkedCase marked_;
    CaseStore& store_ = marked_.store;
    NoProgress quiet_;

    CaseDeletion() { finishJob(); }

    void finishJob()
    {
        JobQueue queue(store_.database(), {});
        queue.complete(*queue.claim(thisOwner()));
    }
    void remove(bool accept_losses = false) { deleteCase(store_, "c1", accept_losses, "a test", quiet_); }
    std::string refusal(bool accept_losses = false)
    {
        try {
            remove(accept_losses);
        } catch (const Error& e) {
            return e.what();
        }
        return {};
    }
    void sign()
    {
        marked_.add({"m1", "m2"});
        marked_.choose();
        const SigningOptions options{.signers = {thisPerson()}};
        keepVersion(store_, "c1", draftVersion(store_, options, "c1", true, "0.1.0"), "a PDF");
    }
    OutboxObject object(const std::string& uid)
    {
        const fs::path file = store_.caseFolder("c1") / (uid + ".dcm");
        replaceFile(file, uid);
        return {file, "1.2", uid};
    }
    int count(const std::string& table, const std::string& where = "1 = 1")
    {
        int rows = 0;
        store_.database().session() << "SELECT COUNT(*) FROM " + table + " WHERE " + where, soci::into(rows);
        return rows;
    }
};

TEST_F(CaseDeletion, TakesEveryRowAndFileAndLeavesTheAuditTrail)
{
    sign();
    makePrivateFolder(store_.folder() / "quarantine" / "c1");
    replaceFile(store_.folder() / "quarantine" / "c1" / "1.dcm", "of another patient");
    const CaseSize size = sizeOfCase(store_, "c1");
    EXPECT_EQ(size.scans, 1);
    EXPECT_GT(size.bytes, 0u);
    remove(true);
    for (const char* table : kCaseTables)
        EXPECT_EQ(count(table, "case_id = 'c1'"), 0) << table;
    EXPECT_EQ(count("cases"), 0);
    EXPECT_EQ(count("counters", "name <> 'search words'"), 0);
    EXPECT_EQ(count("deletions"), 0);
    for (const char* place : {"cases/c1", "quarantine/c1", "in_use/c1"})
        EXPECT_FALSE(fs::exists(store_.folder() / place)) << place;
    EXPECT_FALSE(hasBegunDeletions(store_));
    const auto trail = auditTrail(store_, "c1");
    EXPECT_EQ(trail.front().event, "imported");
    EXPECT_EQ(trail.back().event, "case deleted");
    EXPECT_EQ(trail.back().detail, "a test: 1 scans, 0 objects, report signed, version 1");
}

TEST_F(CaseDeletion, TakesThePatientsEarlierReportsWithTheLastCase)
{
    store_.database().session() << "UPDATE cases SET patient_id = 'P1'";
    CaseRecord second = store_.requireCase("c1");
    second.id = "c2";
    second.study.uid = "1.2.4";
    ScanRecord scan = marked_.scan;
    scan.case_id = "c2";
    makePrivateFolder(store_.scanFolder("c2", scan.id));
    store_.addScan(second, scan, {}, false);
    const auto keep = [&](const std::string& uid, const std::string& patient_id) {
        makePrivateFolder(keptReportsFolder(store_));
        replaceFile(keptReportsFolder(store_) / uid, uid);
        KeptReport report{.sop_uid = uid, .sha256 = sha256(uid), .file = uid};
        report.patient.id = patient_id;
        keepReport(store_, report);
    };
    keep("1.1", "P1");
    keep("1.2", "P2");
    remove(true);
    EXPECT_EQ(keptReportsOf(store_, "P1").size(), 1u) << "the patient has another case";
    deleteCase(store_, "c2", true, "a test", quiet_);
    EXPECT_EQ(keptReportsOf(store_, "P1").size(), 0u);
    EXPECT_FALSE(fs::exists(keptReportsFolder(store_) / "1.1"));
    EXPECT_EQ(keptReportsOf(store_, "P2").size(), 1u);
    EXPECT_TRUE(fs::exists(keptReportsFolder(store_) / "1.2"));
}

TEST_F(CaseDeletion, KnowsEveryTableOfSqliteThatHoldsSomethingOfACase)
{
    std::vector<std::string> known(kCaseTables.begin(), kCaseTables.end());
    known.insert(known.end(), {"audit", "deletions"});
    const soci::rowset<std::string> tables =
        (store_.database().session().prepare
         << "SELECT m.name FROM sqlite_master m WHERE m.type = 'table'"
            " AND EXISTS (SELECT 1 FROM pragma_table_info(m.name) WHERE name = 'case_id')");
    for (const std::string& table : tables)
        EXPECT_THAT(known, Contains(table)) << "a deleted case would leave something there: see case_tables.h";
}

TEST_F(CaseDeletion, DoesNotTakeWhatIsReadAndNotSignedUnasked)
{
    EXPECT_THAT(refusal(), HasSubstr("its report is not signed"));
    EXPECT_EQ(store_.markers("c1").size(), 3u);
    EXPECT_TRUE(fs::exists(marked_.scanFolder()));
    sign();
    beginAmendment(store_, {.signers = {thisPerson()}}, "c1", "a word");
    EXPECT_THAT(refusal(), HasSubstr("amendment of its report is not signed"));
    cancelAmendment(store_, {.signers = {thisPerson()}}, "c1");
    EXPECT_EQ(refusal(), "");
    EXPECT_FALSE(store_.findCase("c1"));
}

TEST_F(CaseDeletion, DoesNotTakeWhatIsNotDeliveredOrInQuarantineUnasked)
{
    sign();
    const auto items = queueObjects(store_, "c1", "main", {object("1.2.3.4"), object("1.2.3.5")});
    EXPECT_THAT(refusal(), HasSubstr("2 of its objects are not delivered"));
    Outbox outbox(store_.database(), {});
    for (const OutboxItem& item : outbox.claim("a")) {
        outbox.markStored(item);
        outbox.markUnconfirmed(item);
    }
    makePrivateFolder(store_.folder() / "quarantine" / "c1");
    replaceFile(store_.folder() / "quarantine" / "c1" / "1.dcm", "of another patient");
    EXPECT_THAT(refusal(), HasSubstr("1 objects that came with it are in quarantine"));
    EXPECT_EQ(refusal(true), "");
    EXPECT_EQ(count("outbox"), 0);
}

TEST_F(CaseDeletion, NeverTakesWhatSomebodyHasOpenOrWorksOn)
{
    {
        const CaseInUse reader(store_.folder(), "c1"), another(store_.folder(), "c1");
        EXPECT_THAT(refusal(true), HasSubstr("somebody has the case open"));
    }
    JobQueue queue(store_.database(), {});
    queue.retry("c1", "s1");
    const auto job = queue.claim(thisOwner());
    EXPECT_THAT(refusal(true), HasSubstr("a worker is at work on scan s1"));
    EXPECT_TRUE(fs::exists(marked_.scanFolder()));
    queue.complete(*job);
    EXPECT_EQ(refusal(true), "");
}

TEST_F(CaseDeletion, IsTheOnlyWayForAVersionOfAReportToGo)
{
    sign();
    EXPECT_THROW(
        store_.database().write([](soci::session& sql) { sql << "DELETE FROM report_versions WHERE case_id = 'c1'"; }),
        Error);
    EXPECT_EQ(count("report_versions"), 1);
}

/// What a deletion that was killed before its commit leaves; a store that is opened then writes the case's copies anew.
TEST_F(CaseDeletion, KilledBeforeItHeldGivesTheCaseBack)
{
    replaceFile(marked_.scanFolder() / "mask.mha", "a mask");
    const fs::path aside = store_.folder() / "deleted" / "c1-a_mark" / "case";
    makePrivateFolder(aside.parent_path());
    fs::rename(store_.caseFolder("c1"), aside);
    CaseStore again(store_.place());
    EXPECT_TRUE(hasBegunDeletions(again));
    makePrivateFolder(again.scanFolder("c1", "s1"));
    replaceFile(again.scanFolder("c1", "s1") / "scan.json", "written meanwhile");
    finishDeletions(again, StoreLock(again.folder(), quiet_));
    EXPECT_EQ(readFile(marked_.scanFolder() / "mask.mha"), "a mask");
    EXPECT_FALSE(hasBegunDeletions(store_));
    EXPECT_EQ(store_.markers("c1").size(), 3u);
}

TEST_F(CaseDeletion, KilledAfterItHeldIsBroughtToAnEnd)
{
    const fs::path aside = store_.folder() / "deleted" / "c0-a_mark" / "case";
    makePrivateFolder(aside);
    replaceFile(aside / "mask.mha", "a mask");
    store_.database().write(
        [](soci::session& sql) { sql << "INSERT INTO deletions (mark, case_id) VALUES ('a_mark', 'c0')"; });
    finishDeletions(store_, StoreLock(store_.folder(), quiet_));
    EXPECT_FALSE(hasBegunDeletions(store_));
    EXPECT_EQ(count("deletions"), 0);
    EXPECT_FALSE(fs::exists(store_.caseFolder("c0")));
}

class Purge : public CaseDeletion {
protected:
    static constexpr double kFreeGb = 10;

    /// A further case of which nobody said anything, in which nothing happened since `day`.
    void addUntouched(const std::string& id, const std::string& day)
    {
        store_.database().write([&](soci::session& sql) {
            const std::string at = day + "T00:00:00Z", uid = "1.2." + id.substr(1);
            sql << "INSERT INTO cases VALUES (:id, :uid, '', '', '', '', '{}', '[]', :at)", soci::use(id),
                soci::use(uid), soci::use(at);
        });
    }
    std::vector<std::string> planned(const PurgeOptions& options, const std::string& now = "2026-03-01T00:00:00Z")
    {
        std::vector<std::string> going;
        for (const PurgeCandidate& candidate : planPurge(store_, options, kFreeGb, now))
            if (candidate.kept.empty())
                going.push_back(candidate.case_id);
        return going;
    }
};

TEST_F(Purge, TakesWhatIsOldAndSigned)
{
    sign();
    const std::string in_a_year = std::to_string(std::stoi(nowUtc().substr(0, 4)) + 1) + nowUtc().substr(4);
    EXPECT_THAT(planned({.after_days = 30}, nowUtc()), IsEmpty());
    EXPECT_THAT(planned({.after_days = 30}, in_a_year), ElementsAre("c1"));
    EXPECT_THAT(planned({.after_days = 400}, in_a_year), IsEmpty());
}

TEST_F(Purge, SaysWhyAnOldCaseStays)
{
    const auto plan = planPurge(store_, {.after_days = 1, .also_unread = true}, kFreeGb, "2999-01-01T00:00:00Z");
    ASSERT_EQ(plan.size(), 1u);
    EXPECT_THAT(plan.front().kept, HasSubstr("its report is not signed"));
}

TEST_F(Purge, TakesUnreadCasesOnlyWhenTold)
{
    addUntouched("c7", "2026-01-01");
    addUntouched("c8", "2026-02-27");
    EXPECT_THAT(planned({.after_days = 30}), IsEmpty());
    EXPECT_THAT(planned({.after_days = 30, .also_unread = true}), ElementsAre("c7"));
}

TEST_F(Purge, MakesRoomByTheLongestUntouchedAndNoMoreThanNeeded)
{
    addUntouched("c7", "2026-01-01");
    addUntouched("c8", "2026-02-01");
    makePrivateFolder(store_.caseFolder("c7"));
    fs::resize_file((replaceFile(store_.caseFolder("c7") / "a", "a"), store_.caseFolder("c7") / "a"), 3'000'000'000);
    EXPECT_THAT(planned({.least_free_gb = kFreeGb + 2, .also_unread = true}), ElementsAre("c7"));
    EXPECT_THAT(planned({.least_free_gb = kFreeGb + 4, .also_unread = true}), ElementsAre("c7", "c8"));
    EXPECT_THAT(planned({.least_free_gb = kFreeGb, .also_unread = true}), IsEmpty());
}

}  // namespace
}  // namespace vicon

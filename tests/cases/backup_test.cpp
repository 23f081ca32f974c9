// A backup is the store as it was at one moment, also while others work on it, and a whole store comes of it.
#include "vicon/cases/backup.h"

#include <gmock/gmock.h>
#include <soci/soci.h>

#include <fstream>
#include <thread>

#include "finding_fixture.h"
#include "this_person.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/error.h"
#include "vicon/support/message_of.h"

namespace vicon {
namespace {

namespace fs = std::filesystem;
using support::messageOf;
using testing::HasSubstr;

class SqliteBackup : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    test::MarkedCase marked_;
    CaseStore& store_ = marked_.store;
    NoProgress quiet_;
    const fs::path to_ = folder_ / "backup", restored_ = folder_ / "restored";

    void SetUp() override
    {
        addObject("1.2.3.1", "first");
        marked_.add({"m1", "m2"});
        marked_.choose();
        keepVersion(store_, "c1", draftVersion(store_, {.signers = {thisPerson()}}, "c1", true, "0.1.0"), "a PDF");
    }
    void addObject(const std::string& uid, const std::string& content)
    {
        const fs::path dicom = marked_.scanFolder() / "dicom";
        makePrivateFolder(dicom);
        replaceFile(dicom / (uid + ".dcm"), content);
        store_.addScan(store_.requireCase("c1"), marked_.scan, {{uid, "c1", "s1", sha256(content), uid + ".dcm"}},
                       true);
    }
    CopyCounts backUpNow() { return backUp(store_, to_, quiet_); }
    CopyCounts restoreNow() { return restore(to_, restored_, quiet_); }
};

TEST_F(SqliteBackup, GivesTheSameStoreBack)
{
    makePrivateFolder(store_.folder() / "incoming" / "a");
    replaceFile(store_.folder() / "incoming" / "a" / "1.dcm", "received, not imported");
    for (const char* of_listener : {"receiver.lock", "arrivals-1.journal"})
        replaceFile(store_.folder() / "incoming" / of_listener, "");
    const CopyCounts made = backUpNow();
    EXPECT_EQ(made.cases, 1);
    EXPECT_EQ(made.copied, made.files);
    EXPECT_EQ(restoreNow().files, made.files);
    CaseStore again(restored_);
    EXPECT_EQ(toJson(again.markers("c1")), toJson(store_.markers("c1")));
    EXPECT_EQ(reportVersions(again, "c1").at(0).digest, reportVersions(store_, "c1").at(0).digest);
    EXPECT_EQ(faultOf(reportVersions(again, "c1").at(0)), "");
    EXPECT_EQ(readFile(again.scanFolder("c1", "s1") / "dicom" / "1.2.3.1.dcm"), "first");
    EXPECT_EQ(readFile(restored_ / "incoming" / "a" / "1.dcm"), "received, not imported");
    EXPECT_EQ(std::distance(fs::directory_iterator(restored_ / "incoming"), {}), 1) << "nothing of the listener's own";
    EXPECT_EQ(fs::status(restored_ / "vicon.db").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(SqliteBackup, CopiesOnlyWhatIsNewAndForgetsWhatIsGone)
{
    const CopyCounts first = backUpNow();
    const CopyCounts same = backUpNow();
    EXPECT_EQ(same.copied, 0);
    EXPECT_EQ(same.files, first.files);
    addObject("1.2.3.2", "second");
    fs::remove(store_.caseFolder("c1") / "markers.json");
    const CopyCounts changed = backUpNow();
    EXPECT_EQ(changed.copied, 2) << "the object and scan.json";
    EXPECT_EQ(changed.removed, 1);
    EXPECT_EQ(readFile(to_ / "cases" / "c1" / "s1" / "dicom" / "1.2.3.2.dcm"), "second");
}

/// Objects come and steps end all the while; whatever the backup's database speaks of must lie in the backup.
TEST_F(SqliteBackup, IsConsistentWhileOthersWriteToTheStore)
{
    std::atomic<int> added = 0;
    const std::jthread others([&](const std::stop_token& stop) {
        CaseStore own(store_.folder());
        const fs::path dicom = marked_.scanFolder() / "dicom";
        for (int n = 0; !stop.stop_requested(); ++n) {
            const std::string uid = "1.2.9." + std::to_string(n);
            {
                const StoreLock lock(own.folder(), quiet_);
                replaceFile(dicom / (uid + ".dcm"), uid);
                own.addScan(own.requireCase("c1"), marked_.scan, {{uid, "c1", "s1", sha256(uid), uid + ".dcm"}}, true);
            }
            added = n;
            // Between two imports, of which each waits for the disk.
            own.audit(AuditEvent::case_opened, "c1", "", "");
            own.audit(AuditEvent::case_opened, "c1", "", "");
        }
    });
    for (int round = 0; round < 3; ++round) {
        const int before = added;
        EXPECT_TRUE(support::waitUntil([&] { return added > before; }));
        backUpNow();
        fs::remove_all(restored_);
        EXPECT_TRUE(restoreNow().faults.empty());
        EXPECT_GE(int(CaseStore(restored_).instances("c1", "s1").size()), before);
    }
}

/// Does something once, when the copying has come to its last file: all that it changes was copied before.
class AtTheLastFile : public NoProgress {
public:
    explicit AtTheLastFile(std::function<void()> action) : action_(std::move(action)) {}
    void report(double, std::string_view what) override
    {
        round_ = what == "copying what is new" ? 1 : what == "copying what came meanwhile" ? 2 : 0;
        files_ = 0;
    }
    /// Asked before every file.
    bool cancelled() const override
    {
        ++files_;
        if (round_ == 1)
            files_of_round_ = files_;
        if (round_ == 2 && files_ == files_of_round_ && !std::exchange(done_, true))
            action_();
        return false;
    }
    bool done() const { return done_; }

private:
    std::function<void()> action_;
    int round_ = 0;
    mutable int files_ = 0, files_of_round_ = 0;
    mutable bool done_ = false;
};

TEST_F(SqliteBackup, HoldsAReportThatIsSignedWhileItIsMade)
{
    makePrivateFolder(store_.folder() / "incoming" / "a");
    replaceFile(store_.folder() / "incoming" / "a" / "1.dcm", "the last file");
    beginAmendment(store_, {.signers = {thisPerson()}}, "c1", "a word");
    AtTheLastFile progress([&] {
        CaseStore of_reader(store_.folder());
        keepVersion(of_reader, "c1", draftVersion(of_reader, {.signers = {thisPerson()}}, "c1", true, "0.1.0"),
                    "an amended PDF");
        addCorrections(of_reader, {}, marked_.scan, {.cut = {{1, 2, 3}}});
    });
    backUp(store_, to_, progress);
    ASSERT_TRUE(progress.done());
    EXPECT_TRUE(restoreNow().faults.empty());
    CaseStore again(restored_);
    ASSERT_EQ(reportVersions(again, "c1").size(), 2u);
    EXPECT_EQ(faultOf(reportVersions(again, "c1").at(1)), "");
    EXPECT_EQ(readCorrections(again.scanFolder("c1", "s1")).cut.size(), 1u);
}

TEST_F(SqliteBackup, KeepsTheEarlierCopyOfWhatTheStoreHasLost)
{
    backUpNow();
    fs::remove_all(marked_.scanFolder() / "dicom");
    const CopyCounts made = backUpNow();
    ASSERT_EQ(made.faults.size(), 1u);
    EXPECT_EQ(textOf(made.faults.front()),
              "case c1: cases/c1/s1/dicom/1.2.3.1.dcm is missing in the store; its earlier"
              " copy stays in the backup");
    EXPECT_EQ(readFile(to_ / "cases" / "c1" / "s1" / "dicom" / "1.2.3.1.dcm"), "first");
    EXPECT_TRUE(restoreNow().faults.empty()) << "the backup is whole";
    EXPECT_EQ(readFile(restored_ / "cases" / "c1" / "s1" / "dicom" / "1.2.3.1.dcm"), "first");
}

TEST_F(SqliteBackup, OfAStoreThatLostAnObjectIsRestoredWithTheRest)
{
    addObject("1.2.3.2", "second");
    fs::remove(marked_.scanFolder() / "dicom" / "1.2.3.2.dcm");
    const CopyCounts made = backUpNow();
    EXPECT_FALSE(nlohmann::json::parse(readFile(to_ / "backup.json")).at("whole"));
    const CopyCounts restored = restoreNow();
    for (const CopyCounts& counts : {made, restored}) {
        ASSERT_EQ(counts.faults.size(), 1u);
        EXPECT_EQ(textOf(counts.faults.front()), "case c1: cases/c1/s1/dicom/1.2.3.2.dcm is missing");
    }
    EXPECT_EQ(readFile(restored_ / "cases" / "c1" / "s1" / "dicom" / "1.2.3.1.dcm"), "first");
    EXPECT_EQ(CaseStore(restored_).instances("c1", "s1").size(), 2u) << "what is missing is known";
}

TEST_F(SqliteBackup, HoldsWhatPseudonymsWatchingAndCommitmentsRestOn)
{
    for (const char* folder : {"watch", "commitments"}) {
        makePrivateFolder(store_.folder() / folder);
        replaceFile(store_.folder() / folder / "1", folder);
    }
    replaceFile(store_.folder() / "anonymous.key", "a key");
    const CopyCounts made = backUpNow();
    EXPECT_EQ(restoreNow().files, made.files);
    EXPECT_EQ(readFile(restored_ / "anonymous.key"), "a key");
    for (const char* folder : {"watch", "commitments"})
        EXPECT_EQ(readFile(restored_ / folder / "1"), folder);
    EXPECT_EQ(backUpNow().copied, 0);
}

TEST_F(SqliteBackup, IsRestoredButForWhatIsDamagedAndSaysWhatThatIs)
{
    backUpNow();
    std::ofstream(to_ / "cases" / "c1" / "s1" / "dicom" / "1.2.3.1.dcm") << "other";
    const CopyCounts restored = restoreNow();
    ASSERT_EQ(restored.faults.size(), 1u);
    EXPECT_EQ(textOf(restored.faults.front()), "case c1: cases/c1/s1/dicom/1.2.3.1.dcm is not what it was");
    EXPECT_EQ(faultOf(reportVersions(*std::make_unique<CaseStore>(restored_), "c1").at(0)), "");
}

/// Does something when a backup says for the first time that it does this.
class When : public NoProgress {
public:
    When(std::string said, std::function<void()> action) : said_(std::move(said)), action_(std::move(action)) {}
    void report(double, std::string_view what) override
    {
        if (what == said_ && !std::exchange(done_, true))
            action_();
    }
    bool done() const { return done_; }

private:
    std::string said_;
    std::function<void()> action_;
    bool done_ = false;
};

TEST_F(SqliteBackup, HoldsNobodyUpWhileItCopiesTheDatabaseAndIsOfTheMomentBefore)
{
    When copying("copying the database", [&] {
        CaseStore of_reader(store_.folder());
        const StoreLock of_import(store_.folder(), quiet_);
        of_reader.flag("c1", "later");
    });
    backUp(store_, to_, copying);
    ASSERT_TRUE(copying.done());
    restoreNow();
    EXPECT_TRUE(CaseStore(restored_).requireCase("c1").flags.empty());
}

TEST_F(SqliteBackup, HoldsAReportThatIsSignedAsLateAsCanBe)
{
    CaseRecord other = store_.requireCase("c1");
    other.id = "c2";
    other.study.uid = "1.2.4";
    makePrivateFolder(store_.scanFolder("c2", "s1"));
    store_.addScan(other, {.id = "s1", .case_id = "c2"}, {}, false);
    beginAmendment(store_, {.signers = {thisPerson()}}, "c1", "a word");
    CaseStore of_reader(store_.folder());
    // Both cases are changed while all is copied; the first is signed when its turn is over once more.
    When changing("copying what came meanwhile", [&] {
        for (const char* id : {"c1", "c2"})
            of_reader.audit(AuditEvent::case_opened, id, "", "");
    });
    When signing("copying case c2", [&] {
        keepVersion(of_reader, "c1", draftVersion(of_reader, {.signers = {thisPerson()}}, "c1", true, "0.1.0"),
                    "an amended PDF");
    });
    struct Both : NoProgress {
        When &one, &other;
        Both(When& first, When& second) : one(first), other(second) {}
        void report(double fraction, std::string_view what) override
        {
            one.report(fraction, what);
            other.report(fraction, what);
        }
    } both(changing, signing);
    backUp(store_, to_, both);
    ASSERT_TRUE(changing.done() && signing.done());
    EXPECT_TRUE(restoreNow().faults.empty());
    EXPECT_EQ(reportVersions(*std::make_unique<CaseStore>(restored_), "c1").size(), 2u);
}

TEST_F(SqliteBackup, ThatWasBrokenOffIsNotRestored)
{
    struct Cancelled : NoProgress {
        bool cancelled() const override { return true; }
    } cancelled;
    EXPECT_THROW(backUp(store_, to_, cancelled), Error);
    EXPECT_THAT(messageOf([&] { restoreNow(); }), HasSubstr("no finished backup"));
    EXPECT_FALSE(fs::exists(restored_));
}

TEST_F(SqliteBackup, NeitherOverwritesAStoreNorAnythingElse)
{
    EXPECT_THAT(messageOf([&] { backUp(store_, store_.folder() / "backup", quiet_); }), HasSubstr("cannot lie in"));
    std::ofstream(folder_ / "letter.txt") << "of somebody";
    EXPECT_THAT(messageOf([&] { backUp(store_, folder_.path(), quiet_); }), HasSubstr("something else"));
    CaseStore other(folder_ / "other");
    EXPECT_THAT(messageOf([&] { backUp(store_, other.folder(), quiet_); }), HasSubstr("something else"));
    backUpNow();
    EXPECT_THAT(messageOf([&] { restore(to_, other.folder(), quiet_); }), HasSubstr("into an empty folder"));
    EXPECT_TRUE(fs::exists(folder_ / "letter.txt"));
}

}  // namespace
}  // namespace vicon

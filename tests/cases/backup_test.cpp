// A backup is the store as it was at one moment, also while others work on it, and a whole store comes of it.
#include "vicon/cases/backup.h"

#include <gmock/gmock.h>
#include <soci/soci.h>

#include <fstream>
#include <thread>

#include "finding_fixture.h"
#include "this_person.h"
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
        EXPECT_EQ(messageOf([&] { restoreNow(); }), "");
        EXPECT_GE(int(CaseStore(restored_).instances("c1", "s1").size()), before);
    }
}

TEST_F(SqliteBackup, ThatWasBrokenOffOrDamagedIsNotRestored)
{
    struct Cancelled : NoProgress {
        bool cancelled() const override { return true; }
    } cancelled;
    EXPECT_THROW(backUp(store_, to_, cancelled), Error);
    EXPECT_THAT(messageOf([&] { restoreNow(); }), HasSubstr("no whole backup"));
    backUpNow();
    std::ofstream(to_ / "cases" / "c1" / "s1" / "dicom" / "1.2.3.1.dcm") << "other";
    EXPECT_THAT(messageOf([&] { restoreNow(); }), HasSubstr("the backup is damaged"));
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

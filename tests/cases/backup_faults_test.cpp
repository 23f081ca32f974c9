// What the store lost, or holds something else in place of, never costs the copy of an earlier backup.
#include <gmock/gmock.h>
#include <soci/soci.h>

#include <filesystem>

#include "finding_fixture.h"
#include "this_person.h"
#include "vicon/cases/backup.h"
#include "vicon/cases/case_deletion.h"
#include "vicon/cases/report_files.h"
#include "vicon/core/error.h"
#include "vicon/support/message_of.h"

namespace vicon {
namespace {

namespace fs = std::filesystem;
using support::messageOf;
using testing::HasSubstr;

/// A case with an object and a signed report with one, and a backup of it.
class SqliteBackupOfFaults : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    test::MarkedCase marked_;
    CaseStore& store_ = marked_.store;
    NoProgress quiet_;
    const fs::path to_ = folder_ / "backup", restored_ = folder_ / "restored";
    const fs::path object_ = "cases/c1/s1/dicom/1.dcm", pdf_ = "cases/c1/report/version-1.pdf",
                   sr_ = "cases/c1/report/version-1-sr.dcm";

    void SetUp() override
    {
        addObject("1", "an object");
        marked_.add({"m1", "m2"});
        marked_.choose();
        replaceFile(folder_ / "version-1-sr.dcm", "an SR");
        keepVersion(store_, "c1", draftVersion(store_, {.signers = {thisPerson()}}, "c1", true, "0.1.0"), "a PDF",
                    {.files = {folder_ / "version-1-sr.dcm"}});
        EXPECT_TRUE(backUpNow().faults.empty());
    }
    void addObject(const std::string& name, const std::string& content)
    {
        makePrivateFolder(marked_.scanFolder() / "dicom");
        replaceFile(marked_.scanFolder() / "dicom" / (name + ".dcm"), content);
        store_.addScan(store_.requireCase("c1"), marked_.scan, {{name, "c1", "s1", sha256(content), name + ".dcm"}},
                       true);
    }
    CopyCounts backUpNow() { return backUp(store_, to_, quiet_); }
    bool isWhole() const { return nlohmann::json::parse(readFile(to_ / "backup.json")).at("whole"); }
    /// As an earlier VICON kept the version.
    void forgetHashesOfObjects()
    {
        store_.database().write([](soci::session& sql) {
            sql << "DROP TRIGGER report_versions_are_not_changed";
            sql << "UPDATE report_versions SET objects = ''";
        });
    }
};

void expectFaults(const CopyCounts& counts, FileFault::Kind kind, const std::vector<fs::path>& files)
{
    std::vector<fs::path> at_fault;
    for (const FileFault& fault : counts.faults) {
        EXPECT_EQ(fault.kind, kind) << textOf(fault);
        EXPECT_EQ(fault.case_id, "c1");
        at_fault.push_back(fault.file);
    }
    EXPECT_THAT(at_fault, testing::UnorderedElementsAreArray(files));
}

TEST_F(SqliteBackupOfFaults, KeepsTheEarlierCopyOfWhatIsNoLongerWhatItWas)
{
    for (const fs::path& file : {object_, pdf_, sr_})
        replaceFile(store_.folder() / file, "locked by somebody who wants money");
    for (int night = 1; night <= 2; ++night) {
        SCOPED_TRACE(night);
        const CopyCounts made = backUpNow();
        expectFaults(made, FileFault::Kind::changed_kept, {object_, pdf_, sr_});
        EXPECT_EQ(made.copied, 0);
        EXPECT_TRUE(isWhole()) << "the backup is";
    }
    EXPECT_TRUE(restore(to_, restored_, quiet_).faults.empty());
    EXPECT_EQ(readFile(restored_ / object_), "an object");
    EXPECT_EQ(readFile(restored_ / pdf_), "a PDF");
    EXPECT_EQ(readFile(restored_ / sr_), "an SR");
    replaceFile(store_.folder() / object_, "an object");
    replaceFile(store_.folder() / pdf_, "a PDF");
    replaceFile(store_.folder() / sr_, "an SR");
    EXPECT_TRUE(backUpNow().faults.empty()) << "put back";
}

TEST_F(SqliteBackupOfFaults, KeepsTheEarlierCopyOfAReportsObjectThatIsLost)
{
    fs::remove(store_.folder() / sr_);
    const CopyCounts made = backUpNow();
    expectFaults(made, FileFault::Kind::kept, {sr_});
    EXPECT_EQ(made.removed, 0);
    EXPECT_TRUE(restore(to_, restored_, quiet_).faults.empty());
    EXPECT_EQ(readFile(restored_ / sr_), "an SR");
}

TEST_F(SqliteBackupOfFaults, KeepsObjectsOfReportsWhoseHashesNobodyKept)
{
    forgetHashesOfObjects();
    replaceFile(store_.folder() / sr_, "something else");
    expectFaults(backUpNow(), FileFault::Kind::changed_kept, {sr_});
    fs::remove(store_.folder() / sr_);
    expectFaults(backUpNow(), FileFault::Kind::kept, {sr_});
    EXPECT_TRUE(restore(to_, restored_, quiet_).faults.empty());
    EXPECT_EQ(readFile(restored_ / sr_), "an SR");
}

TEST_F(SqliteBackupOfFaults, SaysEachTimeWhatItNeverHadAGoodCopyOf)
{
    addObject("2", "another");
    const fs::path other = "cases/c1/s1/dicom/2.dcm";
    replaceFile(store_.folder() / other, "damaged");
    for (int night = 1; night <= 2; ++night) {
        SCOPED_TRACE(night);
        expectFaults(backUpNow(), FileFault::Kind::changed, {other});
        EXPECT_FALSE(isWhole());
        EXPECT_EQ(readFile(to_ / other), "damaged") << "better than nothing";
    }
    expectFaults(restore(to_, restored_, quiet_), FileFault::Kind::changed, {other});
    replaceFile(store_.folder() / other, "another");
    EXPECT_TRUE(backUpNow().faults.empty());
    EXPECT_EQ(readFile(to_ / other), "another");
}

TEST_F(SqliteBackupOfFaults, OfAStoreThatKnowsNoneOfItsCasesIsRefused)
{
    CaseStore anew(folder_ / "anew");
    EXPECT_THAT(
        messageOf([&] { backUp(anew, to_, quiet_); }),
        testing::AllOf(HasSubstr("holds 1 cases, and this store never had one of them"), HasSubstr("'vicon restore'")));
    EXPECT_EQ(restore(to_, restored_, quiet_).cases, 1);
}

TEST_F(SqliteBackupOfFaults, ForgetsCasesThatWereDeleted)
{
    deleteCase(store_, "c1", true, "a test", quiet_);
    const CopyCounts made = backUpNow();
    EXPECT_EQ(made.cases, 0);
    EXPECT_TRUE(made.faults.empty());
    EXPECT_FALSE(fs::exists(to_ / object_));
}

}  // namespace
}  // namespace vicon

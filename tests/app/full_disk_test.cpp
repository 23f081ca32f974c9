// A disk that is full: one line that says so, everything as it was, and the same goes through once there is room.
#include <gmock/gmock.h>
#include <sqlite3.h>

#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"
#include "vicon/core/file.h"
#include "vicon/ingest/sender.h"
#include "vicon/support/small_disk.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using nlohmann::json;
using testing::AnyOf;
using testing::HasSubstr;

constexpr int kDisk_mb = 64;

class FullDisk : public testing::Test {
protected:
    TemporaryFolder outside_;
    const fs::path store_ = outside_ / "store";  // the disk itself: what a listener logs lies beside it
    const SmallDisk disk_{store_, kDisk_mb};
    NoProgress quiet_;

    void SetUp() override { VICON_NEEDS_DISK(disk_); }
    CommandResult vicon(const std::string& arguments) const
    {
        return runVicon(arguments + " --store " + store_.string());
    }
    /// A study of slices of so many pixels a side.
    std::vector<fs::path> study(const std::string& name, int slices, int side) const
    {
        test::SeriesSpec spec;
        spec.study_uid += "." + name;
        spec.series_uid = spec.study_uid + ".1";
        spec.slices = slices;
        spec.columns = spec.rows = side;
        return test::writeSeries(outside_ / name, spec);
    }
    std::string cases() const { return viconJson(store_, "cases").dump(); }
};

/// One line of an error, beside those of progress, in the words of a full disk.
void expectOneLine(const CommandResult& result)
{
    EXPECT_EQ(result.exit_code, 1) << result.output;
    const auto lines = linesWithoutProgress(result.output);
    ASSERT_EQ(lines.size(), 1u) << result.output;
    EXPECT_THAT(lines[0], testing::StartsWith("vicon: "));
    EXPECT_THAT(lines[0], testing::AnyOf(HasSubstr("No space left on device"), HasSubstr("full")));
}

TEST_F(FullDisk, AnImportLeavesTheStoreAsItWasAndGoesThroughLater)
{
    study("1", 12, 16);
    study("2", 40, 128);
    viconOn(store_, "import " + (outside_ / "1").string());
    const auto files = filesOf(store_);
    const std::string listed = cases();
    for (const int left_kb : {0, 16, 200, 1000}) {
        SCOPED_TRACE(left_kb);
        disk_.fill(std::uintmax_t(left_kb) * 1024);
        expectOneLine(vicon("import " + (outside_ / "2").string()));
        disk_.clear();
        EXPECT_EQ(filesOf(store_), files);
        EXPECT_EQ(cases(), listed);
    }
    viconOn(store_, "import " + (outside_ / "2").string());
    const fs::path other = outside_ / "other";
    viconOn(other, "import " + (outside_ / "1").string());
    viconOn(other, "import " + (outside_ / "2").string());
    EXPECT_EQ(filesOf(store_), filesOf(other));
}

TEST_F(FullDisk, ABackupSaysSoAndIsMadeLater)
{
    study("1", 40, 128);
    const fs::path store = outside_ / "other", backup = store_ / "backup";
    viconOn(store, "import " + (outside_ / "1").string());
    for (const int left_kb : {200, 1000}) {
        SCOPED_TRACE(left_kb);
        disk_.fill(std::uintmax_t(left_kb) * 1024);
        expectOneLine(runVicon("backup " + backup.string() + " --store " + store.string()));
        disk_.clear();
    }
    viconOn(store, "backup " + backup.string());
    disk_.fill(200 * 1024);
    expectOneLine(runVicon("restore " + backup.string() + " --store " + (store_ / "restored").string()));
    disk_.clear();
    fs::remove_all(store_ / "restored");
    viconOn(store_ / "restored", "restore " + backup.string());
    EXPECT_EQ(filesOf(store_ / "restored"), filesOf(store));
}

TEST_F(FullDisk, TheListenerRefusesObjectsWithA700AndTakesThemLater)
{
    const auto files = study("1", 12, 16);
    const RunningListener listener(store_, "--set receive.quiet_s=0");
    disk_.fill(0);
    const auto refused = ingest::storeFiles(listener.peer(), files, "SCANNER", quiet_);
    ASSERT_EQ(refused.failures.size(), files.size());
    EXPECT_FALSE(refused.failures[0].for_good);
    EXPECT_THAT(refused.failures[0].reason, HasSubstr("a700"));
    EXPECT_THAT(listener.log(), HasSubstr("was refused: the store's disk is full"));
    disk_.clear();
    EXPECT_TRUE(ingest::storeFiles(listener.peer(), files, "SCANNER", quiet_).complete());
    EXPECT_TRUE(waitUntil([&] { return viconJson(store_, "cases")["cases"].size() == 1; }));
}

TEST_F(FullDisk, AnObjectThatTheDiskHasNoRoomForIsRefusedWithA700)
{
    const auto files = study("1", 1, 5000);  // 50 MB
    const auto small = study("2", 12, 16);
    const RunningListener listener(store_, "--set receive.quiet_s=0");
    disk_.fill(40'000'000);
    const auto refused = ingest::storeFiles(listener.peer(), files, "SCANNER", quiet_);
    ASSERT_EQ(refused.failures.size(), 1u);
    EXPECT_FALSE(refused.failures[0].for_good);
    EXPECT_THAT(refused.failures[0].reason, HasSubstr("a700"));
    EXPECT_THAT(listener.log(), HasSubstr("was refused: it has no room on the store's disk"));
    EXPECT_TRUE(ingest::storeFiles(listener.peer(), small, "SCANNER", quiet_).complete()) << listener.log();
    EXPECT_TRUE(waitUntil([&] { return viconJson(store_, "cases")["cases"].size() == 1; }));
}

TEST_F(FullDisk, WhatWasReceivedAndHasNoRoomInItsCaseWaitsForIt)
{
    const auto files = study("1", 40, 1024);  // 84 MB, twice; while they come in, once, and a journal of 32 MB
    disk_.resize(152);
    const RunningListener listener(store_, "--set receive.quiet_s=0");
    EXPECT_TRUE(ingest::storeFiles(listener.peer(), files, "SCANNER", quiet_).complete());
    EXPECT_TRUE(waitUntil([&] {
        return listener.log().find("40 received objects could not be taken and wait in incoming: ") !=
               std::string::npos;
    })) << listener.log();
    EXPECT_THAT(listener.log(), HasSubstr("No space left on device"));
    EXPECT_TRUE(viconJson(store_, "cases")["cases"].empty());
    disk_.resize(256);
    EXPECT_TRUE(waitUntil([&] { return viconJson(store_, "cases")["cases"].size() == 1; })) << listener.log();
}

TEST_F(FullDisk, AStepWhoseResultHasNoRoomIsNoFailureAndIsDoneLater)
{
    viconOn(store_, "import " + smallStudy().string());
    const auto files = filesOf(store_);
    for (const int left_kb : {300, 1500, 6000}) {
        SCOPED_TRACE(left_kb);
        disk_.fill(std::uintmax_t(left_kb) * 1024);
        const CommandResult done = vicon("work --until-idle --set work.longest_wait_s=0");
        EXPECT_EQ(done.exit_code, 0) << done.output;
        // By the file that had no room, or by the database, whichever asked first.
        EXPECT_THAT(done.output, AnyOf(HasSubstr("No space left on device"), HasSubstr("disk is full")));
        EXPECT_THAT(done.output, HasSubstr("0 done, 0 failed, 1 waiting"));
        disk_.clear();
        // As if the half minute after which the worker looks again were over.
        sqlite3* database = nullptr;
        ASSERT_EQ(sqlite3_open((store_ / "vicon.db").c_str(), &database), SQLITE_OK);
        EXPECT_EQ(sqlite3_exec(database, "UPDATE jobs SET not_before = 0", nullptr, nullptr, nullptr), SQLITE_OK);
        sqlite3_close(database);
    }
    viconOn(store_, "work --until-idle");
    const fs::path other = outside_ / "other";
    viconOn(other, "import " + smallStudy().string());
    viconOn(other, "work --until-idle");
    EXPECT_EQ(filesOf(store_), filesOf(other));
}

}  // namespace
}  // namespace vicon::support

// A store that is read-only, or whose database somebody holds: one clear line, nothing lost, and it goes on afterwards.
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

using testing::HasSubstr;

class StoreTrouble : public testing::Test {
protected:
    TemporaryFolder outside_;
    const fs::path store_ = outside_ / "store";
    const SmallDisk disk_{store_, 64};
    const std::vector<fs::path> files_ = test::writeSeries(outside_ / "study", {});
    NoProgress quiet_;

    std::size_t cases() const { return viconJson(store_, "cases")["cases"].size(); }
};

TEST_F(StoreTrouble, AReadOnlyStoreIsOneLineWhateverIsAskedAndWorksAfterwards)
{
    VICON_NEEDS_DISK(disk_);
    const std::string import = "import " + (outside_ / "study").string();
    viconOn(store_, import);
    const auto files = filesOf(store_);
    disk_.setReadOnly(true);
    for (const std::string& asked :
         {import, std::string("cases"), std::string("work --until-idle"), std::string("receive --no-work --port 0")}) {
        SCOPED_TRACE(asked);
        const CommandResult result = runVicon(asked + " --store " + store_.string());
        EXPECT_EQ(result.exit_code, 1);
        const auto lines = linesWithoutProgress(result.output);
        ASSERT_EQ(lines.size(), 1u) << result.output;
        EXPECT_THAT(lines[0], HasSubstr("Read-only file system"));
    }
    disk_.setReadOnly(false);
    EXPECT_EQ(filesOf(store_), files);
    viconOn(store_, import);
    EXPECT_EQ(cases(), 1u);
}

/// Waits out the minute that a busy database is given.
TEST_F(StoreTrouble, TheListenerKeepsWhatCameWhileTheDatabaseIsLocked)
{
    const RunningListener listener(store_, "--set receive.quiet_s=0");
    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open((store_ / "vicon.db").c_str(), &other), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
    EXPECT_TRUE(ingest::storeFiles(listener.peer(), files_, "SCANNER", quiet_).complete());
    const auto says = [&](const std::string& words) { return listener.log().find(words) != std::string::npos; };
    const auto told = [&] { return says("12 received objects could not be taken and wait in incoming: "); };
    EXPECT_TRUE(waitUntil(told) || waitUntil(told)) << listener.log();
    EXPECT_THAT(listener.log(), HasSubstr("another program keeps the database busy; nothing was saved"));
    sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
    sqlite3_close(other);
    EXPECT_TRUE(waitUntil([&] { return cases() == 1; })) << listener.log();
    EXPECT_FALSE(fs::exists(store_ / "quarantine"));
}

}  // namespace
}  // namespace vicon::support

// A signature that cannot be given: a clear word, nothing signed, nothing lost, and it is given once the trouble is
// over.
#include <gmock/gmock.h>
#include <sqlite3.h>

#include "study.h"
#include "vicon/core/file.h"
#include "vicon/support/small_disk.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class SignTrouble : public testing::Test {
protected:
    TemporaryFolder folder_;
    const SmallDisk disk_{folder_.path(), 400};
    const fs::path store_ = folder_ / "store", config_ = folder_ / "c.toml";
    ListedScan scan_;
    json before_;

    void SetUp() override
    {
        const std::string person = runCommand("id -un").output;
        replaceFile(config_, "[roles]\nsign = [\"" + person.substr(0, person.find('\n')) + "\"]\n");
        scan_ = readSmallStudy(store_, "--note 'as seen'");
        before_ = viconJson(store_, "finding " + scan_.case_id);
    }
    /// @param before what a shell runs first, ended by a semicolon
    CommandResult sign(const std::string& before = "", const std::string& more = "") const
    {
        return runCommand("( " + before + viconBinary() + " sign " + scan_.case_id + " --store " + store_.string() +
                          " --config " + config_.string() + " " + more + " )");
    }
    /// One line that says so, and all as it was; then it is signed.
    void expectUnsigned(const CommandResult& result, const std::string& words)
    {
        EXPECT_EQ(result.exit_code, 1) << result.output;
        EXPECT_THAT(result.output, HasSubstr(words));
        EXPECT_THAT(result.output, HasSubstr("vicon: "));
        EXPECT_EQ(result.output.find("signed by"), std::string::npos) << result.output;
        EXPECT_EQ(viconJson(store_, "finding " + scan_.case_id), before_);
        const fs::path report = store_ / "cases" / scan_.case_id / "report";
        std::error_code none;
        for (const auto& file : fs::directory_iterator(report, none))
            ADD_FAILURE() << file.path().filename() << " is there";
    }
    void expectSigned() const
    {
        const CommandResult result = sign();
        EXPECT_EQ(result.exit_code, 0) << result.output;
        EXPECT_EQ(viconJson(store_, "finding " + scan_.case_id)["state"], "signed");
        EXPECT_TRUE(fs::exists(store_ / "cases" / scan_.case_id / "report/version-1-sr.dcm"));
    }
};

TEST_F(SignTrouble, SignsNothingWhereFilesCannotGrowFontsAreMissingOrAPictureCannotBeDrawn)
{
    // As on a full disk, at several places: no file of the command may grow beyond so many blocks of 1024 bytes.
    for (const char* blocks : {"1", "40", "300"}) {
        SCOPED_TRACE(blocks);
        expectUnsigned(sign("trap '' XFSZ; ulimit -f " + std::string(blocks) + "; "), "");
    }
    expectUnsigned(sign("", "--set report.font_folder=" + (folder_ / "no-fonts").string()), "fonts-noto-core");
    const fs::path cells = scan_.folder / "cells.vtp", volume = scan_.folder / "volume.mha";
    const std::string whole = readFile(cells);
    replaceFile(cells, whole.substr(0, whole.size() / 2));
    expectUnsigned(sign(), "cells.vtp");
    replaceFile(cells, whole);
    fs::rename(volume, folder_ / "volume.mha");
    expectUnsigned(sign(), "volume.mha");
    fs::rename(folder_ / "volume.mha", volume);
    expectSigned();
}

TEST_F(SignTrouble, SignsNothingForAPeerThatNobodyKnowsAndAllTheSameWithoutALogo)
{
    const CommandResult refused = sign("", "--set 'report.send_to=[\"zz\"]'");
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output, HasSubstr("no peer of that name in the configuration"));
    EXPECT_EQ(refused.output.find("signing"), std::string::npos) << "before anything is drawn";
    const CommandResult told = sign("", "--set report.logo=" + (folder_ / "nope.png").string());
    EXPECT_EQ(told.exit_code, 0) << told.output;
    EXPECT_THAT(told.output, HasSubstr("the site's logo cannot be read: " + (folder_ / "nope.png").string()));
}

TEST_F(SignTrouble, SignsNothingOnAFullDisk)
{
    VICON_NEEDS_DISK(disk_);
    for (const int left_kb : {0, 64, 300, 1000}) {
        SCOPED_TRACE(left_kb);
        disk_.fill(std::uintmax_t(left_kb) * 1024);
        const CommandResult result = sign();
        disk_.clear();
        EXPECT_EQ(linesWithoutProgress(result.output).size(), 1u) << result.output;
        EXPECT_THAT(result.output, testing::AnyOf(HasSubstr("No space left on device"), HasSubstr("full")));
        expectUnsigned(result, "");
    }
    expectSigned();
}

/// Waits out the minute that a busy database is given.
TEST_F(SignTrouble, SignsNothingWhileTheDatabaseIsLocked)
{
    sqlite3* other = nullptr;
    ASSERT_EQ(sqlite3_open((store_ / "vicon.db").c_str(), &other), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
    const CommandResult result = sign();
    sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
    sqlite3_close(other);
    expectUnsigned(result, "another program keeps the database busy; nothing was saved");
    expectSigned();
}

}  // namespace
}  // namespace vicon::support

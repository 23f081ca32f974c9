#include "trial_record.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

class TrialRecordInAFolder : public ::testing::Test {
protected:
    support::TemporaryFolder folder_;
};

TEST_F(TrialRecordInAFolder, CountsTheDeathsOfThoseWhoTookTheseFiles)
{
    const fs::path folder = folder_.path();
    EXPECT_TRUE(readTrial(folder).files.empty());
    {
        const TrialRecord record(folder, {{folder / "a", folder / "b" / "c"}, 1});
        const Trial died = readTrial(folder);
        EXPECT_EQ(died.files, (std::vector<fs::path>{folder / "a", folder / "b" / "c"}));
        EXPECT_EQ(died.deaths, 2);
    }
    EXPECT_TRUE(readTrial(folder).files.empty()) << "nobody died";
}

TEST_F(TrialRecordInAFolder, ThatIsNotAsViconWritesItSaysNothing)
{
    const fs::path folder = folder_.path();
    for (const char* content : {"", "[]", "{}", R"({"files":[1],"deaths":1})", R"({"files":7,"deaths":1})",
                                R"({"files":["a"],"deaths":"1"})", R"({"files":["a"],"deaths":1e300})", "\xFF"}) {
        replaceFile(folder / "being_taken.json", content);
        EXPECT_TRUE(readTrial(folder).files.empty()) << content;
    }
}

}  // namespace
}  // namespace vicon::ingest

// Wherever a store lies, its database lies in it, for its owner alone.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "vicon/cases/case_store.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

class StorePath : public testing::TestWithParam<const char*> {
protected:
    support::TemporaryFolder folder;
};

TEST_P(StorePath, HoldsItsDatabaseAndNothingBesideIt)
{
    const fs::path root = folder / "root", place = root / GetParam();
    fs::create_directories(root);
    {
        const CaseStore store(place);
        EXPECT_TRUE(fs::is_regular_file(place / "vicon.db"));
        for (const auto& entry : fs::directory_iterator(place)) {
            struct stat about {};
            ASSERT_EQ(::stat(entry.path().c_str(), &about), 0);
            EXPECT_TRUE(!entry.is_regular_file() || (about.st_mode & 0077) == 0) << entry.path();
        }
    }
    for (const auto& entry : fs::directory_iterator(root))
        EXPECT_EQ(entry.path(), place);
    EXPECT_NO_THROW(CaseStore again(place));
}

INSTANTIATE_TEST_SUITE_P(Names, StorePath,
                         testing::Values("plain", "with space", "two  spaces ", "quote\"d", "apostrophe's",
                                         "Übung-患者", "semi;colon", "equals=sign", "dbname=x timeout=1",
                                         "latin-\xe9"));

}  // namespace

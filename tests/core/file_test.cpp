#include "vicon/core/file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "vicon/core/error.h"
#include "vicon/core/file_modes.h"
#include "vicon/core/temporary_folder.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;

namespace vicon {
namespace {

unsigned modeOf(const fs::path& path)
{
    struct stat info {};
    ::stat(path.c_str(), &info);
    return info.st_mode & 0777;
}

TEST(ReplaceFile, LeavesTheOldFileWhenWritingFails)
{
    const support::TemporaryFolder folder;
    replaceFile(folder / "a.txt", "old");
    EXPECT_THROW(replaceFile(folder / "a.txt",
                             [](const fs::path& temporary) {
                                 std::ofstream(temporary) << "half";
                                 throw std::runtime_error("power cut");
                             }),
                 std::runtime_error);
    EXPECT_EQ(readFile(folder / "a.txt"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}), 1)
        << "no temporary is left";
}

TEST(ReplaceFile, KeepsTheExtensionForWritersThatLookAtIt)
{
    const support::TemporaryFolder folder;
    replaceFile(folder / "a.mha", [](const fs::path& temporary) {
        EXPECT_EQ(temporary.extension(), ".mha");
        std::ofstream(temporary) << "x";
    });
}

TEST(ReplaceFile, MakesFilesThatOnlyTheOwnerReads)
{
    const support::TemporaryFolder folder;
    makePrivateFolder(folder / "a" / "b");
    replaceFile(folder / "a" / "b" / "c", "x");
    EXPECT_EQ(modeOf(folder / "a"), 0700u);
    EXPECT_EQ(modeOf(folder / "a" / "b"), 0700u);
    EXPECT_EQ(modeOf(folder / "a" / "b" / "c"), 0600u);
}

TEST(ReplaceFile, InAFolderThatAGroupSharesMakesFilesAndFoldersOfTheGroup)
{
    const support::TemporaryFolder folder;
    const fs::path shared = folder / "shared";
    makePrivateFolder(shared);
    ASSERT_EQ(::chmod(shared.c_str(), 02770), 0);
    for (const mode_t umask : {0077U, 0022U, 0007U}) {
        const mode_t before = ::umask(umask);
        const fs::path made = shared / std::to_string(umask);
        makePrivateFolder(made / "b");
        replaceFile(made / "b" / "c", "x");
        ::close(openOrMake(made / "lock"));
        ::umask(before);
        EXPECT_EQ(modeOf(made / "b"), 0770u);
        EXPECT_NE(fs::status(made / "b").permissions() & fs::perms::set_gid, fs::perms::none) << "it hands it on";
        EXPECT_EQ(modeOf(made / "b" / "c"), 0660u);
        EXPECT_EQ(modeOf(made / "lock"), 0660u);
    }
}

TEST(ReplaceFile, WhereTheGroupMayOnlyWriteNothingIsGivenToIt)
{
    const support::TemporaryFolder folder;
    ASSERT_EQ(::chmod(folder.path().c_str(), 0770), 0);  // the file's group would be whichever its account has
    replaceFile(folder / "a", "x");
    EXPECT_EQ(modeOf(folder / "a"), 0600u);
}

TEST(ReplaceFile, SaysWhichFolderIsMissing)
{
    try {
        replaceFile("/nonexistent-vicon/a.txt", "x");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::store);
        EXPECT_THAT(e.what(), testing::HasSubstr("/nonexistent-vicon/a.txt"));
    }
}

TEST(TemporaryFolder, ThatCannotBeMadeSaysWhatToSet)
{
    const support::TemporaryFolder folder;
    const char* before = std::getenv("TMPDIR");
    const std::string kept = before ? before : "";
    ::setenv("TMPDIR", (folder / "none").c_str(), 1);
    try {
        makeTemporaryFolder("vicon-", ErrorCode::store);
        ADD_FAILURE();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), testing::StartsWith("TMPDIR: no temporary folder can be made ("));
    }
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    EXPECT_EQ(makeTemporaryFolder("vicon-", ErrorCode::store).parent_path(), folder.path());
    before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
}

TEST(RemoveTemporaries, TakesOnlyWhatAKilledWriterLeft)
{
    const support::TemporaryFolder folder;
    std::string temporary(kTemporaryPrefix);
    temporary += "1-0-a.txt";
    std::ofstream(folder / temporary) << "x";
    std::ofstream(folder / "b.txt") << "x";
    removeTemporaries(folder.path());
    EXPECT_TRUE(fs::exists(folder / "b.txt"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}), 1);
}

TEST(Sha256, IsTheStandardsExample)  // FIPS 180-2, appendix B.1
{
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const support::TemporaryFolder folder;
    replaceFile(folder / "abc", "abc");
    EXPECT_EQ(sha256OfFile(folder / "abc"), sha256("abc"));
}

}  // namespace
}  // namespace vicon

#include "vicon/core/file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "vicon/core/error.h"
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
    std::ofstream(folder / (std::string(kTemporaryPrefix) + "1-0-a.txt")) << "x";
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

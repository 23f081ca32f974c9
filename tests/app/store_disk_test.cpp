// On which disks a store may lie.
#include "store_disk.h"

#include <gmock/gmock.h>

#include "vicon/support/support.h"

namespace vicon::app {
namespace {

using testing::HasSubstr;
using Kind = FileSystem::Kind;

TEST(StoreDisk, SqliteNeedsALocalOneAndPostgresqlOneThatAllMachinesShare)
{
    EXPECT_EQ(whyNoStoreOn({Kind::local, "ext4"}, false), "");
    EXPECT_EQ(whyNoStoreOn({Kind::memory, "tmpfs"}, false), "") << "for a try";
    EXPECT_THAT(whyNoStoreOn({Kind::shared, "NFS"}, false), HasSubstr("NFS is no local disk"));
    EXPECT_EQ(whyNoStoreOn({Kind::shared, "NFS"}, true), "");
    for (const bool on_server : {false, true})
        EXPECT_THAT(whyNoStoreOn({Kind::unknown, "SMB"}, on_server), HasSubstr("SMB does not promise"));
}

TEST(StoreDisk, ATryLeavesNothingBehind)
{
    const support::TemporaryFolder folder;
    EXPECT_FALSE(fileSystemOf(folder.path()).name.empty());
    tryFolder(folder.path());
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_ANY_THROW(tryFolder(folder / "none"));
}

}  // namespace
}  // namespace vicon::app

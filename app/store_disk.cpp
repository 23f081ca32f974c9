#include "store_disk.h"

#include <linux/magic.h>
#include <sys/vfs.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

using Kind = FileSystem::Kind;

struct KnownFileSystem {
    unsigned long magic;
    Kind kind;
    const char* name;
};

/// statfs(2); those without a name there are not in linux/magic.h of Debian 12.
constexpr std::array kFileSystems{
    KnownFileSystem{EXT4_SUPER_MAGIC, Kind::local, "ext4"},
    KnownFileSystem{XFS_SUPER_MAGIC, Kind::local, "XFS"},
    KnownFileSystem{BTRFS_SUPER_MAGIC, Kind::local, "Btrfs"},
    KnownFileSystem{F2FS_SUPER_MAGIC, Kind::local, "F2FS"},
    KnownFileSystem{0x2fc12fc1, Kind::local, "ZFS"},
    KnownFileSystem{OVERLAYFS_SUPER_MAGIC, Kind::local, "overlay"},
    KnownFileSystem{TMPFS_MAGIC, Kind::memory, "tmpfs"},
    KnownFileSystem{RAMFS_MAGIC, Kind::memory, "ramfs"},
    KnownFileSystem{NFS_SUPER_MAGIC, Kind::shared, "NFS"},
    KnownFileSystem{CEPH_SUPER_MAGIC, Kind::shared, "CephFS"},
    KnownFileSystem{CIFS_SUPER_MAGIC, Kind::unknown, "SMB"},
    KnownFileSystem{SMB2_SUPER_MAGIC, Kind::unknown, "SMB"},
    KnownFileSystem{SMB_SUPER_MAGIC, Kind::unknown, "SMB"},
    KnownFileSystem{V9FS_MAGIC, Kind::unknown, "9P"},
    KnownFileSystem{AFS_SUPER_MAGIC, Kind::unknown, "AFS"},
    KnownFileSystem{FUSE_SUPER_MAGIC, Kind::unknown, "FUSE"},
};

std::string inHexadecimal(unsigned long magic)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "file system 0x%lx", magic);
    return text.data();
}

}  // namespace

void requireStore(const StorePlace& place)
{
    if (!place.holdsStore() && !place.holdsData())
        throw Error(ErrorCode::not_found, "there is no store here", place.folder.string(),
                    "'vicon import' makes one; --store names another folder");
}

FileSystem fileSystemOf(const fs::path& folder)
{
    struct statfs about {};
    if (::statfs(folder.c_str(), &about) != 0)
        throw Error(ErrorCode::store, std::string("cannot be looked at (") + std::strerror(errno) + ")",
                    folder.string());
    const auto magic = static_cast<unsigned long>(about.f_type) & 0xffffffffUL;
    const auto* const known = std::find_if(kFileSystems.begin(), kFileSystems.end(),
                                           [&](const KnownFileSystem& one) { return one.magic == magic; });
    return known == kFileSystems.end() ? FileSystem{Kind::local, inHexadecimal(magic)}
                                       : FileSystem{known->kind, known->name};
}

std::string whyNoStoreOn(const FileSystem& file_system, bool on_server)
{
    if (file_system.kind == Kind::unknown)
        return file_system.name + " does not promise that a rename, a hard link and a flush hold";
    if (file_system.kind == Kind::shared && !on_server)
        return file_system.name + " is no local disk, which SQLite needs";
    return {};
}

void tryFolder(const fs::path& folder)
{
    const fs::path probe = folder / ".doctor", link = folder / ".doctor-link";
    std::error_code failed;
    fs::remove(link, failed);
    replaceFile(probe, "probe");
    fs::create_hard_link(probe, link, failed);
    fs::remove(probe);
    if (failed)
        throw Error(ErrorCode::store, "there are no hard links (" + failed.message() + "), which results need",
                    folder.string(), "use a local disk, NFS or CephFS");
    fs::remove(link);
}

}  // namespace vicon::app

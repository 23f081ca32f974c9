#include "vicon/core/file_modes.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>

namespace fs = std::filesystem;

namespace vicon {
namespace {

constexpr mode_t kOwnFile = 0600, kSharedFile = 0660, kOwnFolder = 0700, kSharedFolder = 0770;

bool isShared(const fs::path& folder)
{
    struct stat of {};
    constexpr mode_t kBoth = S_ISGID | S_IWGRP;
    return ::stat(folder.empty() ? "." : folder.c_str(), &of) == 0 && (of.st_mode & kBoth) == kBoth;
}

}  // namespace

mode_t fileModeIn(const fs::path& folder)
{
    return isShared(folder) ? kSharedFile : kOwnFile;
}

int openOrMake(const fs::path& file, int flags)
{
    const mode_t mode = fileModeIn(file.parent_path());
    const int opened = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | flags, mode);
    if (opened >= 0)
        ::fchmod(opened, mode);  // whose file it is may; the group's others need not
    return opened;
}

int makeFolder(const fs::path& folder)
{
    const bool shared = isShared(folder.parent_path());
    const mode_t mode = shared ? kSharedFolder : kOwnFolder;
    if (::mkdir(folder.c_str(), mode) != 0)
        return errno;
    // The system hands the group on; what the umask took is given back, unless nothing is missing: a service may be
    // forbidden to set the bit that the folder has already.
    struct stat made {};
    if (::stat(folder.c_str(), &made) == 0 && (made.st_mode & mode) != mode)
        ::chmod(folder.c_str(), (made.st_mode & S_ISGID) | mode);
    return 0;
}

}  // namespace vicon

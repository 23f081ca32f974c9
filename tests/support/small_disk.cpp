#include "vicon/support/small_disk.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

bool writes(const fs::path& file, const std::string& text)
{
    std::ofstream out(file);
    out << text << std::flush;
    return out.good();
}

/// Whether this process now sees mounts that nobody else does. It stays who it is.
bool haveOwnMounts()
{
    static const bool own = [] {
        if (::unshare(CLONE_NEWNS) != 0) {
            const std::string user = std::to_string(::geteuid()), group = std::to_string(::getegid());
            if (::unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0 || !writes("/proc/self/setgroups", "deny") ||
                !writes("/proc/self/uid_map", user + " " + user + " 1") ||
                !writes("/proc/self/gid_map", group + " " + group + " 1"))
                return false;
        }
        return ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
    }();
    return own;
}

std::string sizeOf(int megabytes)
{
    return "size=" + std::to_string(megabytes) + "m";
}

}  // namespace

SmallDisk::SmallDisk(const fs::path& folder, int megabytes) : folder_(folder), filling_(folder / "filling")
{
    fs::create_directories(folder);
    if (!haveOwnMounts() || ::mount("vicon-test", folder_.c_str(), "tmpfs", 0, sizeOf(megabytes).c_str()) != 0)
        missing_ = std::strerror(errno);
}

SmallDisk::~SmallDisk()
{
    if (missing_.empty())
        ::umount2(folder_.c_str(), MNT_DETACH);
}

void SmallDisk::fill(std::uintmax_t but_bytes) const
{
    clear();
    const int file = ::open(filling_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    const auto room = free();
    const int failed = room > but_bytes ? ::posix_fallocate(file, 0, off_t(room - but_bytes)) : 0;
    ::close(file);
    if (failed != 0)
        throw std::runtime_error("the disk cannot be filled");
}

void SmallDisk::clear() const
{
    fs::remove(filling_);
}

void SmallDisk::resize(int megabytes) const
{
    if (::mount("vicon-test", folder_.c_str(), "tmpfs", MS_REMOUNT, sizeOf(megabytes).c_str()) != 0)
        throw std::runtime_error("the disk cannot be made larger");
}

void SmallDisk::setReadOnly(bool read_only) const
{
    if (::mount("vicon-test", folder_.c_str(), "tmpfs", MS_REMOUNT | (read_only ? MS_RDONLY : 0), nullptr) != 0)
        throw std::runtime_error("the disk cannot be made read-only");
}

}  // namespace vicon::support

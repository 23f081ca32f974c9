#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace vicon::support {

/// A disk of a few megabytes that can be filled: a tmpfs over a folder, seen by this process and what it starts alone.
/// Nobody has to be root for it where the system lets users have namespaces. To be made before the process has threads;
/// see VICON_NEEDS_DISK.
class SmallDisk {
public:
    /// @param folder made where it is not there
    SmallDisk(const std::filesystem::path& folder, int megabytes);
    ~SmallDisk();
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    /// Why there is none; empty where it is there.
    const std::string& missing() const { return missing_; }
    std::uintmax_t free() const { return std::filesystem::space(folder_).available; }
    /// Takes all its room but so many bytes.
    void fill(std::uintmax_t but_bytes) const;
    /// Gives back what fill() took.
    void clear() const;
    void resize(int megabytes) const;
    /// While no program has a file open there to write.
    void setReadOnly(bool read_only) const;

private:
    std::filesystem::path folder_, filling_;
    std::string missing_;
};

}  // namespace vicon::support

/// Skips the test, saying so, where no disk can be made.
#define VICON_NEEDS_DISK(disk)     \
    if (!(disk).missing().empty()) \
    GTEST_SKIP() << "needs a disk of its own: " << (disk).missing()

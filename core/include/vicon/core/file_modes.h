#pragma once

#include <sys/types.h>

#include <filesystem>

namespace vicon {

/// What VICON makes is its account's alone: files 0600, folders 0700. In a folder that a group shares, which is setgid
/// and writable by the group (2770), it is the group's too: files 0660, folders 2770. Nobody else has any right.
/// @param folder in which the file is made
mode_t fileModeIn(const std::filesystem::path& folder);

/// Opens a file for reading and writing, made if need be, with the mode of fileModeIn() whatever the umask. Returns a
/// descriptor, else -1 with errno.
/// @param flags more of open()'s, as O_TRUNC
int openOrMake(const std::filesystem::path& file, int flags = 0);

/// Makes one folder. Returns 0, else the system's number for what went wrong; EEXIST where it was there.
int makeFolder(const std::filesystem::path& folder);

}  // namespace vicon

#pragma once

#include <filesystem>

namespace vicon::pipeline {

/// Gives a file that is on the disk a second name in `place`'s folder, in one step: `place` is the old file or the
/// whole new one, also after a crash. Both lie on one file system. Throws Error{store}.
void publishFile(const std::filesystem::path& made, const std::filesystem::path& place);

}  // namespace vicon::pipeline

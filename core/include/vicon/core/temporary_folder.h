#pragma once

#include <filesystem>
#include <string_view>

#include "vicon/core/error.h"

namespace vicon {

/// Makes a folder of its own (0700), whose name begins so, where the system keeps what is temporary. Throws
/// Error{code}.
std::filesystem::path makeTemporaryFolder(std::string_view begins, ErrorCode code);

}  // namespace vicon

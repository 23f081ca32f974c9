#pragma once

#include <filesystem>
#include <string>

#include "vicon/core/error.h"

namespace vicon::ingest {

/// Why a mask's file cannot be used, and what to do.
inline Error maskRefused(const std::filesystem::path& file, const std::string& what, const std::string& remedy)
{
    return {ErrorCode::bad_input, what, file.string(), remedy};
}

}  // namespace vicon::ingest

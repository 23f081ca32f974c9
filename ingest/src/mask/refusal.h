#pragma once

#include <filesystem>
#include <string>

#include "vicon/core/error.h"
#include "vicon/core/printable.h"

namespace vicon::ingest {

/// Why a mask's file cannot be used, and what to do.
inline Error maskRefused(const std::filesystem::path& file, const std::string& what, const std::string& remedy)
{
    return {ErrorCode::bad_input, what, file.string(), remedy};
}

/// What a stranger's header says, as a line shows it.
inline std::string shown(const std::string& text)
{
    constexpr int kLongest = 64;
    return shortened(printable(text), kLongest);
}

}  // namespace vicon::ingest

#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "memory_file.h"

namespace vicon::fuzz {

/// A scan's folder with one file that is filled anew for each input.
class JsonFolder {
public:
    explicit JsonFolder(const std::string& name)
        : folder_(std::filesystem::temp_directory_path() / ("vicon-fuzz-" + name + std::to_string(::getpid()))),
          file_(folder_ / name)
    {
        std::filesystem::create_directories(folder_);
    }

    const std::filesystem::path& fill(const std::uint8_t* data, std::size_t size) const
    {
        std::ofstream(file_, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
        return folder_;
    }

private:
    std::filesystem::path folder_, file_;
};

}  // namespace vicon::fuzz

#pragma once

#include <string_view>
#include <vector>

namespace vicon::pipeline {

struct OrganPreset {
    std::string_view name;
    std::string_view toml;
};

/// The files of config/organs, which travel inside the program; made by CMake.
const std::vector<OrganPreset>& organPresets();

}  // namespace vicon::pipeline

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/core/options.h"

namespace vicon::app {

/// The machine's configuration, which whoever runs VICON there keeps.
inline constexpr const char* kSystemConfig = "/etc/vicon/config.toml";

/// Where the values of options come from, the later the stronger.
struct ConfigSources {
    std::filesystem::path system, user;    ///< files; those that are not there say nothing
    std::vector<std::string> assignments;  ///< "key=value"
};

/// Throws Error{wrong_use}: for what is wrong in a source; where there is a machine's configuration and another source
/// gives roles, for nobody gives them to himself.
Config readConfig(const ConfigSources& sources);

}  // namespace vicon::app

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vicon/core/options.h"

namespace vicon::pipeline {

/// The organs that presets exist for, files of config/organs: "airway", "aorta", "colon".
std::vector<std::string> organNames();

/// Which organ a person said that a scan shows, kept as `organ.json` in its folder; empty: nobody said.
/// Throws Error{bad_input} when the file cannot be understood.
std::string readOrgan(const std::filesystem::path& scan_folder);
/// Throws Error{wrong_use} for an organ without a preset, Error{store}.
void writeOrgan(const std::filesystem::path& scan_folder, const std::string& name);

/// The configuration with the preset of an organ: of `name`, or of organ.name where it is empty. Only options that
/// neither a file nor the command line sets are changed. Throws Error{wrong_use} for an organ without a preset.
Config withOrgan(Config config, const std::string& name);

}  // namespace vicon::pipeline

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/core/options.h"
#include "vicon/core/organ.h"

namespace vicon::pipeline {

/// The organs that presets exist for, files of config/organs: "airway", "aorta", "colon", "stomach".
std::vector<std::string> organNames();

/// The configuration with the preset of an organ; nothing: of organ.name. Only options that neither a file nor the
/// command line sets are changed. Throws Error{wrong_use} for an organ without a preset.
Config withOrgan(Config config, const std::optional<Organ>& organ);

}  // namespace vicon::pipeline

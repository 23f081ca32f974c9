#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vicon::report {

/// What scan.json's "quality" says of the scan as lines: adequate or why not, and its noise; the table of quality has
/// the rest. Measures of another form are listed as they are.
std::string qualityWords(const nlohmann::json& quality);

}  // namespace vicon::report

#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vicon::report {

/// The measures of scan.json's "quality" as lines: adequate or why not, the whole colon, each part. Measures of another
/// form are listed as they are.
std::string qualityWords(const nlohmann::json& quality);

}  // namespace vicon::report

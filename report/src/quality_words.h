#pragma once

#include <string>

#include "vicon/core/scan_quality.h"

namespace vicon::report {

/// Adequate or why not, and the noise, as lines; the table of quality has the rest.
std::string qualityWords(const ScanQuality& quality);

}  // namespace vicon::report

#pragma once

#include <string>
#include <vector>

namespace vicon::app {

/// Columns padded to their widest cell (counted in characters, not bytes), two spaces between them.
std::string formatTable(const std::vector<std::string>& header, std::vector<std::vector<std::string>> rows);

/// "12.3" and the like; `decimals` digits. What rounds to zero has no sign.
std::string formatNumber(double value, int decimals);

}  // namespace vicon::app

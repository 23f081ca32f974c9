#pragma once

#include <string_view>

namespace vicon::viewer {

// The files of config/, put into the program when it is built.
extern const std::string_view kWindowsToml;
extern const std::string_view kTransferFunctionsToml;

}  // namespace vicon::viewer

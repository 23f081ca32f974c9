#pragma once

#include <string>

#include "vicon/core/geometry.h"

namespace vicon::app {

/// "X,Y,Z" of the command line, LPS mm. Throws Error{wrong_use} naming the option.
Point3 pointFrom(const std::string& text, const char* option);

}  // namespace vicon::app

#pragma once

#include <string>

namespace vicon {

/// Who works here; the number where the system knows no name.
std::string thisPerson();

}  // namespace vicon

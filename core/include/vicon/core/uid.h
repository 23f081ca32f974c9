#pragma once

#include <string>
#include <string_view>

namespace vicon {

/// A valid UID below 2.25 that stands for a text: the same text gives the same UID.
std::string uidFor(std::string_view text);

/// A valid UID below 2.25 that nobody can guess.
std::string randomUid();

}  // namespace vicon

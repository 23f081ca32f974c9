#pragma once

#include <string>

namespace vicon {

/// True when `owner` (see thisOwner()) was a process of this machine that does not live any more; the lease of such a
/// worker need not be waited for. Of other machines' processes nothing is known: false.
bool ownerIsGone(const std::string& owner);

/// The machine that a worker runs on.
std::string machineOf(const std::string& owner);

}  // namespace vicon

#pragma once

#include <string>

#include "vicon/core/organ.h"

namespace vicon::viewer {

/// What an organ and the two ends of the way through it are called.
struct OrganWords {
    Organ organ;
    std::string first_end, last_end;
    bool has_path = true;  ///< false: a cavity; both ends are its middle, from which it is looked at first
};

/// Every organ other than the colon branches, from a root to its tips, unless no path leads through it.
OrganWords wordsFor(const Organ& organ, bool has_path = true);

}  // namespace vicon::viewer

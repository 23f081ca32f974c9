#pragma once

#include <string>

#include "vicon/core/organ.h"

namespace vicon::viewer {

/// What an organ and the two ends of the way through it are called.
struct OrganWords {
    Organ organ;
    std::string first_end, last_end;
};

/// Every organ other than the colon branches, from a root to its tips.
OrganWords wordsFor(const Organ& organ);

}  // namespace vicon::viewer

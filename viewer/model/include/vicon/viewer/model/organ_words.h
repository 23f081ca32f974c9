#pragma once

#include <string>

namespace vicon::viewer {

/// What an organ and the two ends of the way through it are called.
struct OrganWords {
    std::string organ, first_end, last_end;

    bool isColon() const { return organ == "colon"; }
};

/// @param organ as the scan's description names it; every other than the colon branches, from a root to its tips
OrganWords wordsFor(const std::string& organ);

}  // namespace vicon::viewer

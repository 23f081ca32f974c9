#pragma once

#include <functional>
#include <string>
#include <vector>

#include "vicon/core/options.h"

namespace vicon::app {

/// An option whose value names something that must be there: a peer, a kind of object, a file, an address.
struct NamedOption {
    const char* option;
    /// Throws Error where it is not there.
    std::function<void(const Config&)> require;
};

/// All of them. Only what this machine has is looked at; no peer is called.
const std::vector<NamedOption>& namedOptions();

/// Throws Error{wrong_use} for peers and kinds of objects that nobody knows: without them no report can be signed, and
/// who starts a listener hears it before a reader does.
void requireDeliverable(const Config& config);

}  // namespace vicon::app

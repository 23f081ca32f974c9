#pragma once

#include <string>

#include "vicon/ingest/peer.h"

namespace vicon::ingest {

/// Without the end of its line; empty where there is no user. Throws Error{wrong_use} when its file cannot be read, or
/// everybody may read it.
std::string passwordOf(const WebAccess& web);

}  // namespace vicon::ingest

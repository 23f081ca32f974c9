#pragma once

#include <string>
#include <vector>

#include "vicon/core/options.h"
#include "vicon/ingest/peer.h"
#include "vicon/ingest/receiver.h"

namespace vicon::app {

/// What a command wants of a peer.
enum class PeerUse { any, query, send };

/// The peer that the configuration calls `name`. Throws Error{wrong_use} naming those there are, when its entry is
/// wrong, or when its roles do not name this use.
ingest::Peer requirePeer(const Config& config, const std::string& name, PeerUse use = PeerUse::any);

/// All of them. Throws Error{wrong_use} when an entry is wrong.
std::vector<ingest::Peer> configuredPeers(const Config& config);

/// Those that may call, and the files for TLS. Throws Error{wrong_use} when an entry is wrong.
ingest::Receiver::Network networkOf(const Config& config);

}  // namespace vicon::app

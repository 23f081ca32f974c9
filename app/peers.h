#pragma once

#include <string>

#include "vicon/core/options.h"
#include "vicon/ingest/receiver.h"
#include "vicon/ingest/sender.h"

namespace vicon::app {

/// The peer that the configuration calls `name`. Throws Error{wrong_use} naming those there are.
ingest::Peer requirePeer(const Config& config, const std::string& name);

/// The listener's options; `peers` in receive.allow stands for the title and host of every configured peer.
ingest::ReceiverOptions receiverOptions(const Config& config);

}  // namespace vicon::app

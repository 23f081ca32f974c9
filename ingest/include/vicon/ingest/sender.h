#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/ingest/peer.h"

namespace vicon::ingest {

/// What a peer made of one object.
struct StoreOutcome {
    std::filesystem::path file;
    bool taken = false;
    bool for_good = false;  ///< it was not taken, and trying again cannot help
    std::string reason;     ///< why it was not taken
};
using OnStored = std::function<void(const StoreOutcome&)>;

/// What a peer made of the objects sent to it.
struct SendResult {
    int sent = 0;
    std::vector<StoreOutcome> failures;
    bool complete() const { return failures.empty(); }
};

/// Sends objects by C-STORE, each in the transfer syntax it is stored in; uncompressed ones in any uncompressed one.
/// @param on_stored told of each object as soon as the peer answered; may be empty
/// @throws Error{peer} when no association can be made or it breaks, Error{cancelled}
SendResult storeFiles(const Peer& peer, const std::vector<std::filesystem::path>& files,
                      const std::string& our_ae_title, Progress& progress, const OnStored& on_stored = {});

/// Verifies that a peer answers C-ECHO. Throws Error{peer}.
void echo(const Peer& peer, const std::string& our_ae_title);

}  // namespace vicon::ingest

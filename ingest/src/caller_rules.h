#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "host_addresses.h"
#include "vicon/ingest/receiver.h"

namespace vicon::ingest {

/// Who may call, and as which peer of the configuration: see receive.allow.
class CallerRules {
public:
    /// Hosts given by name are looked up now and again. Throws Error{wrong_use} for an entry that is none, or when
    /// peers are meant and there are none.
    CallerRules(const ReceiverOptions& options, const std::vector<Peer>& peers);

    /// Why it may not call; empty when it may.
    std::string whyRefused(const std::string& title, const std::string& address) const;
    /// The configured peer of this title at this address; null where there is none: then it may do everything.
    const Peer* peerOf(const std::string& title, const std::string& address) const;
    /// What is to be said of hosts since the last call: that one has no address, or has one again.
    std::vector<std::string> news();

private:
    struct Rule {
        std::string title, host;  ///< empty: any
    };
    bool allows(const Rule& rule, const std::string& title, const std::string& address) const;
    void allowPeers();
    void allow(const std::string& entry);
    std::vector<std::string> hosts() const;

    const std::vector<Peer> peers_;
    std::vector<Rule> rules_;
    std::unique_ptr<HostAddresses> addresses_;  ///< of the hosts of both
    std::set<std::string> without_;             ///< hosts that were said to have none
};

}  // namespace vicon::ingest

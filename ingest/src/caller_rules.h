#pragma once

#include <string>
#include <vector>

#include "vicon/ingest/receiver.h"

namespace vicon::ingest {

/// Who may call, and as which peer of the configuration: see receive.allow.
class CallerRules {
public:
    /// Hosts given by name are looked up now. Throws Error{wrong_use} for an entry that is none, a host that has no
    /// address, or when peers are meant and there are none.
    CallerRules(const ReceiverOptions& options, const std::vector<Peer>& peers);

    /// Why it may not call; empty when it may.
    std::string whyRefused(const std::string& title, const std::string& address) const;
    /// The configured peer of this title at this address; null where there is none: then it may do everything.
    const Peer* peerOf(const std::string& title, const std::string& address) const;
    /// The configured peers whose hosts have no address: they are refused.
    std::vector<std::string> unreachablePeers() const;

private:
    struct Rule {
        std::string title, address;  ///< empty: any
        bool allows(const std::string& other_title, const std::string& other_address) const;
    };
    struct Known {
        Peer peer;
        std::string address;
    };
    void allowPeers();
    void allow(const std::string& entry);

    std::vector<Known> known_;
    std::vector<Rule> rules_;
};

}  // namespace vicon::ingest

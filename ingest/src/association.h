#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/diutil.h>
#include <dcmtk/dcmnet/scu.h>

#include <memory>
#include <string>

#include "vicon/ingest/peer.h"
#include "watched_connection.h"

namespace vicon::ingest {

/// The largest PDU that DCMTK receives.
inline constexpr Uint32 kPduBytes = 131072;

/// How a peer is called in an error.
std::string nameOf(const Peer& peer);

[[noreturn]] void peerFailed(const std::string& what, const Peer& peer, const OFCondition& condition);

/// An association that we open, by TLS where the peer wants it.
class PeerScu : public DcmSCU {
public:
    PeerScu() = default;
    ~PeerScu() override;
    PeerScu(const PeerScu&) = delete;
    PeerScu& operator=(const PeerScu&) = delete;
    /// Throws Error{peer}, and Error{wrong_use} when its TLS files cannot be used.
    void useNetwork(const Peer& peer);
    /// Why something failed: what the peer sent, where DCMTK did not see it, else what DCMTK says.
    OFCondition reasonOf(const OFCondition& failed) const;

private:
    std::unique_ptr<WatchingLayer> layer_;
};

/// Addresses, titles, PDU and time-outs of an association that we open.
void configure(PeerScu& scu, const Peer& peer, const std::string& our_ae_title);

/// Opens the association. Throws Error{peer}.
void connect(PeerScu& scu, const Peer& peer);

}  // namespace vicon::ingest

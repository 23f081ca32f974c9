#include "association.h"

#include <algorithm>

#include "tls_layer.h"
#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr Uint32 kTimeoutSeconds = 30;

}  // namespace

std::string whereIs(const Peer& peer)
{
    return peer.web ? peer.web->url : peer.ae_title + " at " + peer.host + ":" + std::to_string(peer.port);
}

std::string nameOf(const Peer& peer)
{
    return (peer.name.empty() ? "" : peer.name + " ") + "(" + whereIs(peer) + ")";
}

void peerFailed(const std::string& what, const Peer& peer, const OFCondition& condition)
{
    std::string reason = condition.text();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(ErrorCode::peer, what + " (" + reason + ")", nameOf(peer),
                "check its address, port and titles, and that it knows this application");
}

void configure(PeerScu& scu, const Peer& peer, const std::string& our_ae_title)
{
    scu.setAETitle(our_ae_title.c_str());
    scu.setPeerHostName(peer.host.c_str());
    scu.setPeerPort(Uint16(peer.port));
    scu.setPeerAETitle(peer.ae_title.c_str());
    scu.setMaxReceivePDULength(kPduBytes);
    scu.setDIMSEBlockingMode(DIMSE_NONBLOCKING);
    scu.setDIMSETimeout(kTimeoutSeconds);
    scu.setACSETimeout(kTimeoutSeconds);
    scu.setConnectionTimeout(int(kTimeoutSeconds));
}

PeerScu::~PeerScu()
{
    if (isConnected())  // what it does so by goes with this object
        closeAssociation(DCMSCU_ABORT_ASSOCIATION);
}

void PeerScu::useNetwork(const Peer& peer)
{
    if (peer.host.empty())
        throw Error(ErrorCode::wrong_use, "this takes DICOM's own protocol", nameOf(peer),
                    "add host, port and ae_title to the peer");
    OFCondition ready = initNetwork();
    if (ready.good()) {
        layer_ = peer.tls ? tlsLayerFor(peer) : std::make_unique<QuickLayer>();
        ready = useSecureConnection(layer_.get());  // by this layer, secure or not
    }
    if (ready.bad())
        peerFailed("the network cannot be used", peer, ready);
}

OFCondition PeerScu::reasonOf(const OFCondition& failed) const
{
    const auto watch = layer_ ? layer_->watch() : nullptr;
    return watch && !watch->whyEnded().empty()
               ? makeOFCondition(failed.module(), failed.code(), OF_error, watch->whyEnded().c_str())
               : failed;
}

void connect(PeerScu& scu, const Peer& peer)
{
    scu.useNetwork(peer);
    if (const OFCondition agreed = scu.negotiateAssociation(); agreed.bad())
        peerFailed("no association with the peer", peer, agreed);
}

}  // namespace vicon::ingest

#include "association.h"

#include <algorithm>

#include "vicon/core/error.h"

namespace vicon::ingest {
namespace {

constexpr Uint32 kPduBytes = 131072;
constexpr Uint32 kTimeoutSeconds = 30;

}  // namespace

std::string nameOf(const Peer& peer)
{
    return (peer.name.empty() ? "" : peer.name + " ") + "(" + peer.ae_title + " at " + peer.host + ":" +
           std::to_string(peer.port) + ")";
}

void peerFailed(const std::string& what, const Peer& peer, const OFCondition& condition)
{
    std::string reason = condition.text();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(ErrorCode::peer, what + " (" + reason + ")", nameOf(peer),
                "check its address, port and titles, and that it knows this application");
}

void configure(DcmSCU& scu, const Peer& peer, const std::string& our_ae_title)
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

void connect(DcmSCU& scu, const Peer& peer)
{
    if (const OFCondition opened = scu.initNetwork(); opened.bad())
        peerFailed("the network cannot be used", peer, opened);
    if (const OFCondition agreed = scu.negotiateAssociation(); agreed.bad())
        peerFailed("no association with the peer", peer, agreed);
}

}  // namespace vicon::ingest

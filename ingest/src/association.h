#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/diutil.h>
#include <dcmtk/dcmnet/scu.h>

#include <string>

#include "vicon/ingest/sender.h"

namespace vicon::ingest {

/// How a peer is called in an error.
std::string nameOf(const Peer& peer);

[[noreturn]] void peerFailed(const std::string& what, const Peer& peer, const OFCondition& condition);

/// Addresses, titles, PDU and time-outs of an association that we open.
void configure(DcmSCU& scu, const Peer& peer, const std::string& our_ae_title);

/// Opens the association. Throws Error{peer}.
void connect(DcmSCU& scu, const Peer& peer);

}  // namespace vicon::ingest

#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmtls/tlslayer.h>

#include <memory>

#include "vicon/ingest/peer.h"
#include "vicon/ingest/tls.h"
#include "watched_connection.h"

namespace vicon::ingest {

/// What TLS connections are made from. Throws Error{wrong_use} saying which file is at fault.
std::unique_ptr<DcmTLSTransportLayer> makeTlsLayer(const TlsOptions& options);

/// For connections to a peer: its certificate must be trusted and hold its name.
std::unique_ptr<WatchingLayer> tlsLayerFor(const Peer& peer);

}  // namespace vicon::ingest

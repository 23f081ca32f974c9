#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmnet/scpthrd.h>

#include <string>

#include "storage_association.h"

namespace vicon::ingest {

/// A title as it may stand in a log.
std::string printableTitle(std::string title);

/// What is taken of what the association offers, by what this peer may do. @param peer null: everything
DcmSCPConfig configFor(const StorageService& service, const Peer* peer, const T_ASC_Association& association);

/// What the peer asked for and was not granted in any context, by name, the first few; for a log.
std::string servicesNotGranted(const T_ASC_Association& association);

}  // namespace vicon::ingest

#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "vicon/ingest/commitment.h"

namespace vicon::ingest {

inline constexpr int kRequestCommitment = 1;              ///< action type (PS3.4 J.3.2)
inline constexpr int kAllCommitted = 1, kSomeFailed = 2;  ///< event types (PS3.4 J.3.3)

/// The transaction and its objects, as an N-ACTION carries them.
void fillRequest(DcmDataset& dataset, const std::string& transaction_uid, const std::vector<ObjectName>& objects);

/// What an N-EVENT-REPORT says. Throws Error{bad_input} when it names no transaction.
CommitmentReport commitmentReportFrom(DcmDataset& dataset);

}  // namespace vicon::ingest

#pragma once

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dctk.h>

#include "vicon/ingest/commitment.h"

namespace vicon::ingest {

inline constexpr int kRequestCommitment = 1;  ///< action type (PS3.4 J.3.2)
// Failure reasons (PS3.3 C.14.1.1).
inline constexpr int kProcessingFailure = 0x0110, kNoSuchObject = 0x0112, kClassConflict = 0x0119;
inline constexpr int kAllCommitted = 1, kSomeFailed = 2;  ///< event types (PS3.4 J.3.3)

/// The transaction and its objects, as an N-ACTION carries them.
void fillRequest(DcmDataset& dataset, const std::string& transaction_uid, const std::vector<ObjectName>& objects);

/// What an N-ACTION asks for. Throws Error{bad_input} when it names no transaction or no object.
CommitmentDemand commitmentDemandFrom(DcmDataset& dataset);

/// What is answered, as an N-EVENT-REPORT carries it. Returns its event type.
int fillReport(DcmDataset& dataset, const CommitmentReport& report);

/// What an N-EVENT-REPORT says. Throws Error{bad_input} when it names no transaction.
CommitmentReport commitmentReportFrom(DcmDataset& dataset);

}  // namespace vicon::ingest

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/ingest/peer.h"

namespace vicon {
class CaseStore;
}

namespace vicon::ingest {

/// An object as storage commitment names it.
struct ObjectName {
    std::string sop_class, sop_uid;
};

/// What an archive says of objects that it was asked to keep (PS3.4 J.3.3).
struct CommitmentReport {
    struct Failed {
        ObjectName object;
        int reason = 0;  ///< a value of Failure Reason (0008,1197)
    };
    std::string transaction_uid;
    std::vector<ObjectName> committed;
    std::vector<Failed> failed;
};
/// "no such object instance (0112)"
std::string textOfFailureReason(int reason);

enum class CommitmentRequest { taken, not_offered };

/// Asks a peer to commit to keeping objects (Storage Commitment Push Model, PS3.4 J.3.2).
/// @param wait_s how long the association stays open for an answer; it may come later, over one that the peer opens
/// @param answer the peer's, when it came over the same association
/// @throws Error{peer} when the peer cannot be reached or does not take the request
CommitmentRequest requestCommitment(const Peer& peer, const std::string& transaction_uid,
                                    const std::vector<ObjectName>& objects, const std::string& our_ae_title,
                                    double wait_s, std::optional<CommitmentReport>& answer);

/// What a peer asks this store to keep.
struct CommitmentDemand {
    std::string transaction_uid;
    std::vector<ObjectName> objects;
};

/// What this store says to it. It commits to what lies here whole: in a case, as it was imported; in quarantine; or
/// received and waiting for the import. Throws Error{database}, Error{cancelled}.
CommitmentReport commitTo(CaseStore& store, const CommitmentDemand& demand, const Progress& wanted);

/// Tells a peer over an association of its own (N-EVENT-REPORT) what was committed to. Throws Error{peer} when it
/// cannot be reached or does not take the report.
void reportCommitment(const Peer& peer, const CommitmentReport& report, const std::string& our_ae_title);

}  // namespace vicon::ingest

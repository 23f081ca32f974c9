#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/cases/outbox.h"
#include "vicon/core/progress.h"
#include "vicon/ingest/commitment.h"

namespace vicon::ingest {

/// How a delivery goes about it.
struct Delivery {
    OutboxOptions options;
    /// The peer of that name as it is configured now. Throws Error{wrong_use} when there is none.
    std::function<Peer(const std::string&)> peer;
    std::string our_ae_title;
    /// Told of what a peer refused, and of peers that cannot be reached. May be empty.
    std::function<void(const std::string&)> trouble = {};
};

/// A file of a case as the outbox names it. Throws Error{bad_input} when it is no DICOM object.
OutboxObject outboxObject(const std::filesystem::path& file);

/// Sends what is due in the outbox to its peers and asks them to commit to it, until nothing is due. An object counts
/// as delivered when its peer committed to it, or offers no commitment. A peer that cannot be reached, or takes an
/// object not now, is tried again later, as often as it takes; what it refuses for good stays with its reason.
/// @return the number of objects that were due
/// @throws Error{database}, Error{cancelled}; what was sent stands then, and the rest is due again
int deliverDue(CaseStore& store, const Delivery& delivery, const OutboxFilter& wanted, Progress& progress);

/// Notes in the outbox what a peer said of a commitment. Returns how many objects it concerned.
int noteCommitment(Outbox& outbox, const CommitmentReport& report);

}  // namespace vicon::ingest

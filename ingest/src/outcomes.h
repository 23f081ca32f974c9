#pragma once

#include "vicon/ingest/sender.h"

namespace vicon::ingest {

/// Keeps what the peer made of each object, and tells of it.
struct Outcomes {
    SendResult& result;
    const OnStored& on_stored;

    void add(const StoreOutcome& outcome)
    {
        if (outcome.taken)
            ++result.sent;
        else
            result.failures.push_back(outcome);
        if (on_stored)
            on_stored(outcome);
    }
};

/// Whether a status of C-STORE says that the peer has the object: success, with or without a warning, or that it had it
/// before, as where an earlier answer was lost. Whether it has the same bytes, storage commitment says.
bool isTaken(unsigned status);
/// Whether a status of C-STORE says that the object is at fault, or the peer's rules, and not the moment (PS3.4 B.2.3).
bool isForGood(unsigned status);

}  // namespace vicon::ingest

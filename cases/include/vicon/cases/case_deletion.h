#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/store_locks.h"
#include "vicon/core/progress.h"

namespace vicon {

/// What speaks against deleting a case, a line each.
struct DeletionDoubts {
    std::vector<std::string> forbidding;  ///< somebody works on it now
    std::vector<std::string> losses;      ///< what nobody could make again: it takes a person who says so
};
DeletionDoubts doubtsAboutDeleting(CaseStore& store, const std::string& case_id);

/// What a case holds.
struct CaseSize {
    int scans = 0, objects = 0;
    std::uintmax_t bytes = 0;
};
CaseSize sizeOfCase(CaseStore& store, const std::string& case_id);

/// Deletes a case from database and disk, as a whole or not at all, also where it is killed; what its audit trail says
/// stays. Waits for imports. Throws Error{not_found}, Error{store}, Error{database}, Error{cancelled}; Error{wrong_use}
/// where something speaks against it. Nothing was deleted then.
/// @param accept_losses what would be lost for good is no reason against it
/// @param why for the audit trail
void deleteCase(CaseStore& store, const std::string& case_id, bool accept_losses, const std::string& why,
                Progress& progress);

/// Whether a deletion was begun and is not at its end: it goes on now, or was killed.
bool hasBegunDeletions(const CaseStore& store);

/// Brings to an end what a killed deletion left: a case that is still in the database gets its folder back, what
/// belongs to none is removed.
void finishDeletions(CaseStore& store, const StoreLock& held);

}  // namespace vicon

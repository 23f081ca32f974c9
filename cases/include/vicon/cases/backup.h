#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/progress.h"

namespace vicon {

/// What a backup or a restore did.
struct CopyCounts {
    int cases = 0;
    int files = 0;    ///< that there are now
    int copied = 0;   ///< of them, those that were not there or had changed
    int removed = 0;  ///< that were there and belong to nothing any more
    std::uintmax_t bytes_copied = 0;
};

/// Makes `to` a copy of the store, while others work on it: the database as it is at one moment, and with it the files
/// that it speaks of. What lies there from an earlier backup is not copied again. Imports and deletions wait during the
/// last, short round. A backup that was broken off cannot be restored; the next one continues it.
/// Throws Error{store}, Error{database}, Error{cancelled}; Error{wrong_use} where `to` holds something else.
CopyCounts backUp(CaseStore& store, const std::filesystem::path& to, Progress& progress);

/// Makes a store of a backup; where the database of the one that was backed up lies on a server, into an empty database
/// there, which keeps what it was given when an object is found damaged afterwards. Throws Error{bad_input} where that
/// is no whole one, or an object or a report is not what its record says; Error{wrong_use} where there is a store
/// already; Error{store}, Error{database}, Error{cancelled}. The store is not there then.
CopyCounts restore(const std::filesystem::path& backup, const StorePlace& to, Progress& progress);

}  // namespace vicon

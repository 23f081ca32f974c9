#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/progress.h"

namespace vicon {

/// A file that the database speaks of and that a store or its copy does not have as it was.
struct FileFault {
    enum class Kind {
        missing,
        kept,          ///< missing in the store; the backup has the copy of an earlier one
        changed,       ///< its content is not what it was
        changed_kept,  ///< its content in the store is not what it was; the backup has the copy of an earlier one
    };
    std::string case_id;         ///< empty: a report kept of a patient
    std::filesystem::path file;  ///< within the store
    Kind kind = Kind::missing;
};
/// "missing", "kept", "changed" or "changed_kept".
std::string nameOf(FileFault::Kind kind);
/// In a line.
std::string textOf(const FileFault& fault);

/// What a backup or a restore did.
struct CopyCounts {
    int cases = 0;
    int files = 0;    ///< that there are now
    int copied = 0;   ///< of them, those that were not there or had changed
    int removed = 0;  ///< that were there and belong to nothing any more
    std::uintmax_t bytes_copied = 0;
    std::vector<FileFault> faults;  ///< case by case
};

/// Makes `to` a copy of the store, while others work on it: the database as it is at one moment, and with it the files
/// that it speaks of. What lies there from an earlier backup is not copied again, and stays where the store has lost
/// it or holds something else in its place than what its row says: that is among the faults of what is returned.
/// Imports and deletions wait during the last, short round. A backup that was broken off cannot be restored; the next
/// one continues it. Throws Error{store}, Error{database}, Error{cancelled}; Error{wrong_use} where `to` holds
/// something else, or only cases that this store never had: its database is not the one that was backed up.
CopyCounts backUp(CaseStore& store, const std::filesystem::path& to, Progress& progress);

/// Makes a store of a backup; where the database of the one that was backed up lies on a server, into an empty database
/// there. What is missing, or not what its record says, is among the faults of what is returned; the rest is there.
/// Throws Error{bad_input} where that is no finished one; Error{wrong_use} where there is a store already;
/// Error{store}, Error{database}, Error{cancelled}. The store is not there then, and its database as empty as before.
CopyCounts restore(const std::filesystem::path& backup, const StorePlace& to, Progress& progress);

}  // namespace vicon

#pragma once

#include <filesystem>
#include <string>

#include "vicon/cases/case_store.h"

namespace vicon::app {

/// Throws Error{not_found} where there is no store, and nothing of one; Error{store} where this account may not know.
void requireStore(const StorePlace& place);

/// The file system that a folder lies on, as far as it matters to a store.
struct FileSystem {
    enum class Kind {
        local,
        memory,   ///< gone when the machine stops
        shared,   ///< NFS, CephFS: several machines see a rename at once, and a flush reaches the server's disk
        unknown,  ///< over a network or through a program: rename, hard links or flush may not hold
    };
    Kind kind = Kind::local;
    std::string name;
};

/// Throws Error{store}.
FileSystem fileSystemOf(const std::filesystem::path& folder);

/// Why a store should not lie there; empty where it may.
/// @param on_server whether its state lies in PostgreSQL
std::string whyNoStoreOn(const FileSystem& file_system, bool on_server);

/// Writes, flushes, renames, links and removes a file there. Throws Error{store}: what it may not or cannot.
void tryFolder(const std::filesystem::path& folder);

}  // namespace vicon::app

#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

#include "vicon/cases/backup.h"

namespace vicon {

/// What stays in a mirror although its source has lost it, with the folders above: names as mirror() makes them.
using KeptFiles = std::set<std::filesystem::path>;

/// What a mirror asks and tells of single files; each may be empty.
struct MirrorCalls {
    /// The SHA-256 that a file of `from` must have, whose mirror is this file of `to`; empty: any.
    std::function<std::string(const std::filesystem::path&)> sha256_of = {};
    /// A file of `to`, whose source has another SHA-256, stays as it is: good, or as bad. Where there was none, it is
    /// what the source is, and is looked at again the next time.
    std::function<void(const std::filesystem::path&, bool is_good)> changed = {};
    /// Every file of `to`.
    std::function<void(const std::filesystem::path&)> seen = {};
};

/// Makes `to` hold what `from` holds, file by file: what has the same size and time stays, what is in no file of `from`
/// goes, but for `kept`. A file never is there by halves. What disappears from `from` meanwhile is passed over, as are
/// temporaries and locks. Throws Error{store}, Error{cancelled}.
void mirror(const std::filesystem::path& from, const std::filesystem::path& to, const KeptFiles& kept,
            CopyCounts& copied, Progress& progress, const MirrorCalls& calls = {});

/// The same for a single file, which may not be there.
void mirrorFile(const std::filesystem::path& from, const std::filesystem::path& to, CopyCounts& copied);

/// Everything that was written to the disk of this folder so far is there when this returns. Throws Error{store}.
void flushDiskOf(const std::filesystem::path& folder);

}  // namespace vicon

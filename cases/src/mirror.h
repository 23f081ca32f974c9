#pragma once

#include <filesystem>
#include <functional>
#include <set>

#include "vicon/cases/backup.h"

namespace vicon {

/// What stays in a mirror although its source has lost it, with the folders above: names as mirror() makes them.
using KeptFiles = std::set<std::filesystem::path>;

/// Makes `to` hold what `from` holds, file by file: what has the same size and time stays, what is in no file of `from`
/// goes, but for `kept`. A file never is there by halves. What disappears from `from` meanwhile is passed over, as are
/// temporaries and locks. Throws Error{store}, Error{cancelled}.
/// @param seen called with every file of `to`; may be empty
void mirror(const std::filesystem::path& from, const std::filesystem::path& to, const KeptFiles& kept,
            CopyCounts& copied, Progress& progress, const std::function<void(const std::filesystem::path&)>& seen = {});

/// The same for a single file, which may not be there.
void mirrorFile(const std::filesystem::path& from, const std::filesystem::path& to, CopyCounts& copied);

/// Everything that was written to the disk of this folder so far is there when this returns. Throws Error{store}.
void flushDiskOf(const std::filesystem::path& folder);

}  // namespace vicon

#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mirror.h"
#include "recorded_files.h"
#include "vicon/cases/backup.h"

namespace vicon {

/// Copies a store's files, in several rounds over what is there already.
class StoreCopying {
public:
    /// @param recorded what must lie in `from` by its rows; what is something else does not replace a copy. Null: all
    /// is copied as it is.
    StoreCopying(const std::filesystem::path& from, const std::filesystem::path& to, RecordedHashes* recorded,
                 Progress& progress);

    /// What the store has lost, and the copy has: it stays there.
    void keep(const std::vector<FileFault>& missing);
    /// Everything. Throws Error{store}, Error{database}, Error{cancelled}.
    void copyAll(const std::string& name);
    /// These cases alone.
    void copyCases(const std::set<std::string>& cases);
    /// What of the store is not what it was; as the last look at each says.
    std::vector<FileFault> changed() const;
    CopyCounts& counts() { return counts_; }

private:
    MirrorCalls calls();

    std::filesystem::path from_, to_;
    RecordedHashes* recorded_;
    Progress& progress_;
    KeptFiles kept_;
    std::map<std::filesystem::path, FileFault> changed_;  ///< by the file within the store
    CopyCounts counts_;
};

}  // namespace vicon

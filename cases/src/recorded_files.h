#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "vicon/cases/backup.h"

namespace vicon {

/// The files that rows of the database speak of and that are not there. Throws Error{database}, Error{cancelled}.
/// @param backup an earlier one: of versions of reports without hashes of their objects, those that lie in it
/// @param of_cases looks only at these; "" stands for the earlier reports kept of patients. Empty: at all.
std::vector<FileFault> missingFiles(CaseStore& store, const std::filesystem::path& backup, Progress& progress,
                                    const std::set<std::string>& of_cases = {});

/// The same, and those whose content is not what their row says.
std::vector<FileFault> faultyFiles(CaseStore& store, Progress& progress);

/// What files must be, by what rows of the database say of them at this moment; read for one case after the other.
class RecordedHashes {
public:
    RecordedHashes(CaseStore& store, std::filesystem::path backup) : store_(store), backup_(std::move(backup)) {}
    /// SHA-256 of a file within the store, of an object without a hash that of its earlier copy; empty where no row
    /// speaks of it. Throws Error{database}.
    std::string of(const std::filesystem::path& file);
    /// Reads anew from here on.
    void forget() { case_id_.reset(); }

private:
    CaseStore& store_;
    std::filesystem::path backup_;
    std::optional<std::string> case_id_;
    std::map<std::filesystem::path, std::string> hashes_;
};

/// The case whose files lie there, "" of the earlier reports kept of patients; nothing for what no row speaks of.
/// @param file within the store
std::optional<std::string> caseOf(const std::filesystem::path& file);

}  // namespace vicon

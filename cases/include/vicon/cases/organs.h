#pragma once

#include <filesystem>
#include <optional>

#include "vicon/cases/case_store.h"
#include "vicon/core/organ.h"

namespace vicon {

/// Which organ a person said that a scan shows, kept as `organ.json` in its folder; nothing where nobody said.
/// Throws Error{bad_input} when the file cannot be understood.
std::optional<Organ> readOrgan(const std::filesystem::path& scan_folder);
/// Throws Error{store}.
void writeOrgan(const std::filesystem::path& scan_folder, const Organ& organ);

/// Which organ a scan was worked on as: the colon where nobody said otherwise.
Organ organOf(CaseStore& store, const ScanRecord& scan);

}  // namespace vicon

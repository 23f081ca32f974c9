#pragma once

#include <filesystem>
#include <optional>

#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/corrections.h"

namespace vicon {

/// The corrections of a scan, kept as `corrections.json` in its folder; none when there is no such file. Throws
/// Error{bad_input} when it cannot be understood.
Corrections readCorrections(const std::filesystem::path& scan_folder);
/// Replaces the file; no corrections remove it. Throws Error{store}.
void writeCorrections(const std::filesystem::path& scan_folder, const Corrections& corrections);

/// Keeps these as all that was said about a scan's lumen, and puts its job back where it failed; steps that do not
/// depend on them are kept. Throws Error{wrong_use} for a point outside the scan, and for a scan that shows no colon;
/// where the scan must still have the `expected` ones, Error{bad_input} when somebody changed them meanwhile.
void replaceCorrections(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const Corrections& all,
                        const std::optional<Corrections>& expected = std::nullopt);
/// The same with these added to what was said before.
void addCorrections(CaseStore& store, const QueueOptions& options, const ScanRecord& scan, const Corrections& more);

}  // namespace vicon

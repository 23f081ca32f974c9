#pragma once

#include <filesystem>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"

namespace vicon::app {

/// Says of one scan of a case, or of all its scans, that they show an organ. Throws Error{wrong_use} for an organ that
/// there is no preset for.
void setOrgan(CaseStore& store, const Config& config, const std::string& organ, const std::string& case_id,
              const std::string& scan_id);

/// The branches of a scan's skeleton as a table, for `vicon show`; empty where the organ is one path.
std::string branchTable(const std::filesystem::path& scan_folder);

}  // namespace vicon::app

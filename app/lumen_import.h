#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/ingest/import.h"

namespace vicon::app {

/// What `vicon import --mask` says.
struct LumenImport {
    std::string case_id, scan_id;
    std::filesystem::path file;  ///< "none": VICON finds the lumen itself again
    std::optional<int> label;
};

/// Gives a scan another program's lumen, held against the scan first, and puts the scan back into the queue. Returns
/// what a person should know. Throws Error: the store is then as it was.
std::vector<ingest::ImportLine> importLumen(CaseStore& store, const Config& config, const LumenImport& asked,
                                            Progress& progress);

}  // namespace vicon::app

#pragma once

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"
#include "vicon/pipeline/scan_work.h"

namespace vicon::app {

/// The pipeline's work on a scan, with ingest as its source of voxels: the one place where the two meet.
pipeline::JobWork scanWork(CaseStore& store, const Config& config);

/// Puts finished scans that are out of date (other parameters, another version of a step, a lost file) back into the
/// queue: of one case, or of one scan, or all. Only when somebody asks for it, or has changed what a scan is made with.
void requeueOutdated(CaseStore& store, const Config& config, const std::string& case_id = {},
                     const std::string& scan_id = {});

/// How many finished scans are out of date, of the thousand that came last.
int countOutdated(CaseStore& store, const Config& config);

}  // namespace vicon::app

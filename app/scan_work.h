#pragma once

#include "vicon/cases/case_store.h"
#include "vicon/core/options.h"
#include "vicon/pipeline/scan_work.h"

namespace vicon::app {

/// The pipeline's work on a scan, with ingest as its source of voxels: the one place where the two meet.
pipeline::JobWork scanWork(CaseStore& store, const Config& config);

/// Queues every finished scan again whose steps were made with other parameters or other code than today's; the work
/// then redoes exactly what is out of date.
void requeueOutdated(CaseStore& store, const Config& config);

}  // namespace vicon::app

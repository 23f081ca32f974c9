#pragma once

#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"

namespace vicon {

/// What a person said may be what the scan's job lacked: where it ended failed, it is tried again.
inline void retryWhereFailed(CaseStore& store, const QueueOptions& options, const ScanRecord& scan)
{
    JobQueue queue(store.database(), options);
    if (const auto job = queue.find(scan.case_id, scan.id); job && job->state == JobState::failed)
        queue.retry(scan.case_id, scan.id);
}

}  // namespace vicon

#pragma once

#include <string>

#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/file.h"
#include "vicon/support/store_place.h"
#include "vicon/support/support.h"

namespace vicon::test {

/// A store with a case "c1" and its scan "s1", which is in the queue.
class StoreOfOneScan {
public:
    StoreOfOneScan() : store(support::storePlace(folder_ / "store"))
    {
        CaseRecord a_case;
        a_case.id = "c1";
        a_case.study.uid = "1.2.3";
        a_case.created = "2026-01-02T03:04:05Z";
        scan.id = "s1";
        scan.case_id = "c1";
        scan.created = a_case.created;
        makePrivateFolder(scanFolder());
        store.addScan(a_case, scan, {}, true);
    }

    std::filesystem::path scanFolder() const { return store.scanFolder("c1", "s1"); }

    /// Records a step, as a worker does.
    void record(const std::string& step, const nlohmann::json& result)
    {
        JobQueue queue(store.database(), {});
        auto job = queue.find("c1", "s1");
        if (job->state != JobState::running)
            job = queue.claim(thisOwner());
        queue.commitStep(*job, {step, 1, "digest", nlohmann::json::object(), result, 1, "2026-01-02T03:04:05Z"});
    }
    /// The worker gives the job back.
    void release() { JobQueue(store.database(), {}).release(*JobQueue(store.database(), {}).find("c1", "s1")); }
    /// Ends the job.
    void complete() { JobQueue(store.database(), {}).complete(*JobQueue(store.database(), {}).find("c1", "s1")); }
    void fail()
    {
        JobQueue queue(store.database(), {});
        queue.fail(*queue.claim(thisOwner()), "a gap of 40 mm", true);
    }

private:
    support::TemporaryFolder folder_;

public:
    CaseStore store;
    ScanRecord scan;
};

}  // namespace vicon::test

#include "worklist.h"

#include <algorithm>
#include <array>

#include "organs.h"
#include "vicon/cases/job_queue.h"

namespace vicon::app {
namespace {

WorklistScan makeScan(CaseStore& store, JobQueue& queue, const ScanRecord& record)
{
    WorklistScan scan{
        .record = record, .state = "kept", .folder = store.scanFolder(record.case_id, record.id).string()};
    if (const auto job = queue.find(record.case_id, record.id)) {
        scan.state = nameOf(job->state);
        scan.step = job->step;
        scan.progress = job->state == JobState::done ? 1 : job->progress;
        scan.reason = job->reason;
    }
    if (scan.reason.empty())
        for (const StepRecord& step : store.steps(record.case_id, record.id))
            if (std::string warning = verdictWarning(step); !warning.empty())
                scan.reason = std::move(warning);
    return scan;
}

}  // namespace

WorklistCase makeWorklistCase(CaseStore& store, const Config& config, const CaseRecord& record)
{
    JobQueue queue(store.database(), config.get<QueueOptions>());
    WorklistCase out{.record = record, .state = "kept"};
    for (const ScanRecord& scan : store.scans(record.id))
        out.scans.push_back(makeScan(store, queue, scan));
    for (const char* state : {"failed", "running", "queued", "done"}) {
        const auto found = std::find_if(out.scans.begin(), out.scans.end(),
                                        [&](const WorklistScan& scan) { return scan.state == state; });
        if (found == out.scans.end())
            continue;
        out.state = state;
        out.reason = found->reason;
        break;
    }
    for (const std::string& flag : record.flags)  // a person must decide, whatever else there is to say
        out.reason += (out.reason.empty() ? "" : "; ") + flag;
    out.markers = int(store.markers(record.id).size());
    return out;
}

std::vector<WorklistCase> makeWorklist(CaseStore& store, const Config& config)
{
    std::vector<WorklistCase> out;
    for (const CaseRecord& record : store.cases())
        out.push_back(makeWorklistCase(store, config, record));
    return out;
}

nlohmann::json toJson(const std::vector<WorklistCase>& worklist)
{
    nlohmann::json cases = nlohmann::json::array();
    for (const WorklistCase& c : worklist) {
        nlohmann::json scans = nlohmann::json::array();
        for (const WorklistScan& s : c.scans)
            scans.push_back({{"id", s.record.id},
                             {"series_uid", s.record.series.uid},
                             {"series_number", s.record.series.number},
                             {"description", s.record.series.description},
                             {"position", positionName(s.record.series.patient_position)},
                             {"role", s.record.role},
                             {"state", s.state},
                             {"step", s.step},
                             {"progress", s.progress},
                             {"reason", s.reason},
                             {"folder", s.folder}});
        cases.push_back({{"id", c.record.id},
                         {"patient", c.record.patient},
                         {"study_uid", c.record.study.uid},
                         {"study", c.record.study},
                         {"state", c.state},
                         {"reason", c.reason},
                         {"flags", c.record.flags},
                         {"markers", c.markers},
                         {"created", c.record.created},
                         {"scans", scans}});
    }
    return {{"cases", cases}};
}

}  // namespace vicon::app

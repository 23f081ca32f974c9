#include "vicon/cases/worklist.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "vicon/cases/corrections.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/report_files.h"
#include "vicon/cases/step_results.h"

namespace vicon {
namespace {

/// What a radiologist asks first: is it distended, is there fluid, is anything collapsed.
std::string qualityInBrief(const ScanQuality& quality)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "radius %.0f mm, fluid %.0f %%", quality.whole.median_radius_mm,
                  100 * quality.whole.fluidFraction());
    return text.data() + (quality.reason.empty() ? ", nothing collapsed" : ", " + quality.reason);
}

/// What import wrote of a scan that it kept or refused: the reason of the whole, not of single images.
std::string whyNotQueued(const ScanRecord& record)
{
    if (record.role == ScanRole::kept)
        return record.ingest.value("kept_because", "");
    for (const nlohmann::json& entry : record.ingest.value("refused", nlohmann::json::array()))
        if (entry.is_object() && !entry.contains("object"))
            return entry.value("why", "");
    return {};
}

WorklistScan makeScan(CaseStore& store, JobQueue& queue, const ScanRecord& record)
{
    WorklistScan scan{.record = record, .folder = store.scanFolder(record.case_id, record.id)};
    if (record.role == ScanRole::refused) {  // whatever was done before late images spoilt it
        scan.state = WorkState::refused;
        scan.reason = whyNotQueued(record);
        return scan;
    }
    if (const auto job = queue.find(record.case_id, record.id)) {
        scan.state = workStateOf(job->state);
        scan.step = job->step;
        scan.progress = job->state == JobState::done ? 1 : job->progress;
        scan.reason = job->reason;
    }
    const StepResults results = resultsOf(store.steps(record.case_id, record.id));
    if (scan.reason.empty())
        scan.reason = results.warning();
    if (scan.reason.empty() && scan.state == WorkState::kept)
        scan.reason = whyNotQueued(record);
    scan.organ = results.organ();
    if (results.quality && results.quality->quality) {
        scan.adequate = results.quality->quality->whole.adequate;
        scan.quality = qualityInBrief(*results.quality->quality);
    }
    if (!scan.reason.empty())
        scan.corrected = !readCorrections(scan.folder).empty();
    return scan;
}

/// What a case is, is the first of these that any of its scans is.
void sumUp(WorklistCase& a_case)
{
    for (const WorkState state : {WorkState::failed, WorkState::running, WorkState::queued, WorkState::done,
                                  WorkState::kept, WorkState::refused}) {
        const auto found = std::find_if(a_case.scans.begin(), a_case.scans.end(),
                                        [&](const WorklistScan& scan) { return scan.state == state; });
        if (found == a_case.scans.end())
            continue;
        a_case.state = state;
        a_case.reason = found->reason;
        break;
    }
    for (const std::string& flag : a_case.record.flags)  // a person must decide, whatever else there is to say
        a_case.reason += (a_case.reason.empty() ? "" : "; ") + flag;
    int jobs = 0;
    for (const WorklistScan& scan : a_case.scans)
        if (scan.state != WorkState::kept && scan.state != WorkState::refused) {
            a_case.progress += scan.progress;
            ++jobs;
        }
    if (jobs > 0)
        a_case.progress /= jobs;
}

nlohmann::json toJson(const WorklistScan& s)
{
    return {{"id", s.record.id},
            {"series_uid", s.record.series.uid},
            {"series_number", s.record.series.number},
            {"description", s.record.series.description},
            {"position", positionName(s.record.series.patient_position)},
            {"role", nameOf(s.record.role)},
            {"state", nameOf(s.state)},
            {"step", s.step},
            {"progress", s.progress},
            {"reason", s.reason},
            {"folder", s.folder.string()}};
}

}  // namespace

std::string nameOf(WorkState state)
{
    switch (state) {
        case WorkState::kept:
            return "kept";
        case WorkState::refused:
            return "refused";
        case WorkState::queued:
            return nameOf(JobState::queued);
        case WorkState::running:
            return nameOf(JobState::running);
        case WorkState::done:
            return nameOf(JobState::done);
        case WorkState::failed:
            return nameOf(JobState::failed);
    }
    return "kept";
}

WorkState workStateOf(JobState state)
{
    switch (state) {
        case JobState::queued:
            return WorkState::queued;
        case JobState::running:
            return WorkState::running;
        case JobState::done:
            return WorkState::done;
        case JobState::failed:
            return WorkState::failed;
    }
    return WorkState::failed;
}

WorklistCase makeWorklistCase(CaseStore& store, const QueueOptions& options, const CaseRecord& record)
{
    JobQueue queue(store.database(), options);
    WorklistCase a_case{.record = record};
    for (const ScanRecord& scan : store.scans(record.id))
        a_case.scans.push_back(makeScan(store, queue, scan));
    sumUp(a_case);
    a_case.markers = int(store.markers(record.id).size());
    a_case.reports = countReports(store, record.id);
    a_case.delivery = deliveryInBrief(countDeliveries(store, record.id));
    return a_case;
}

std::vector<WorklistCase> makeWorklist(CaseStore& store, const QueueOptions& options)
{
    std::vector<WorklistCase> out;
    for (const CaseRecord& record : store.cases())
        out.push_back(makeWorklistCase(store, options, record));
    return out;
}

nlohmann::json toJson(const std::vector<WorklistCase>& worklist)
{
    nlohmann::json cases = nlohmann::json::array();
    for (const WorklistCase& c : worklist) {
        nlohmann::json scans = nlohmann::json::array();
        for (const WorklistScan& scan : c.scans)
            scans.push_back(toJson(scan));
        cases.push_back({{"id", c.record.id},
                         {"patient", c.record.patient},
                         {"study_uid", c.record.study.uid},
                         {"study", c.record.study},
                         {"state", nameOf(c.state)},
                         {"reason", c.reason},
                         {"flags", c.record.flags},
                         {"markers", c.markers},
                         {"delivery", c.delivery},
                         {"created", c.record.created},
                         {"scans", scans}});
    }
    return {{"cases", cases}};
}

void retryCase(CaseStore& store, const QueueOptions& options, const std::string& case_id)
{
    JobQueue queue(store.database(), options);
    for (const WorklistScan& scan : makeWorklistCase(store, options, store.requireCase(case_id)).scans)
        if (scan.state == WorkState::failed)
            queue.retry(case_id, scan.record.id);
        else if (scan.spoiled())
            replaceCorrections(store, options, scan.record, {});
}

}  // namespace vicon

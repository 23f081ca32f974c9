#include "vicon/cases/worklist.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "search_words.h"
#include "vicon/cases/corrections.h"
#include "vicon/cases/outbox.h"
#include "vicon/cases/report_files.h"
#include "vicon/cases/step_results.h"
#include "worklist_rows.h"

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

WorklistScan makeScan(const CaseStore& store, const WorklistRows& rows, const ScanRecord& record)
{
    WorklistScan scan{.record = record, .folder = store.scanFolder(record.case_id, record.id)};
    if (record.role == ScanRole::refused) {  // whatever was done before late images spoilt it
        scan.state = WorkState::refused;
        scan.reason = whyNotQueued(record);
        return scan;
    }
    const WorklistRows::ScanKey key{record.case_id, record.id};
    if (const auto found = rows.jobs.find(key); found != rows.jobs.end()) {
        const Job& job = found->second;
        scan.state = workStateOf(job.state);
        scan.step = job.step;
        scan.progress = job.state == JobState::done ? 1 : job.progress;
        scan.reason = job.reason;
    }
    const auto steps = rows.steps.find(key);
    const StepResults results = steps == rows.steps.end() ? StepResults{} : resultsOf(steps->second);
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

std::vector<WorklistCase> makeWorklistCases(CaseStore& store, const QueueOptions& options,
                                            const std::vector<CaseRecord>& records)
{
    const WorklistRows rows = worklistRows(store, options, records);
    const auto of = [](const auto& all, const std::string& case_id) {
        const auto found = all.find(case_id);
        return found == all.end() ? typename std::decay_t<decltype(all)>::mapped_type{} : found->second;
    };
    std::vector<WorklistCase> out;
    for (const CaseRecord& record : records) {
        WorklistCase a_case{.record = record};
        for (const ScanRecord& scan : of(rows.scans, record.id))
            a_case.scans.push_back(makeScan(store, rows, scan));
        sumUp(a_case);
        a_case.markers = of(rows.markers, record.id);
        a_case.reports = of(rows.reports, record.id);
        a_case.delivery = deliveryInBrief(of(rows.deliveries, record.id));
        out.push_back(std::move(a_case));
    }
    return out;
}

/// Those of the wanted cases that are in the wanted state; at most `most` of them.
std::vector<WorklistCase> casesInState(CaseStore& store, const QueueOptions& options, WorklistPageWanted wanted,
                                       int most)
{
    constexpr int kAtOnce = 500;
    const bool searched = !wordsIn(wanted.words).empty();
    const int at_once = searched ? kMostLookedAt : std::min(2 * most, kAtOnce);
    std::vector<WorklistCase> out;
    while (true) {
        const std::vector<CaseRecord> records = casesOfPage(store, wanted, at_once);
        for (WorklistCase& one : makeWorklistCases(store, options, records))
            if (one.state == *wanted.state && int(out.size()) < most)
                out.push_back(std::move(one));
        if (searched || int(out.size()) == most || int(records.size()) < at_once)
            return out;
        wanted.after = records.back().id;
    }
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
    return makeWorklistCases(store, options, {record}).front();
}

std::vector<WorklistCase> makeWorklist(CaseStore& store, const QueueOptions& options)
{
    constexpr std::size_t kAtOnce = 500;
    const std::vector<CaseRecord> records = store.cases();
    std::vector<WorklistCase> out;
    for (std::size_t from = 0; from < records.size(); from += kAtOnce) {
        const auto begin = records.begin() + std::ptrdiff_t(from);
        const auto end = begin + std::ptrdiff_t(std::min(kAtOnce, records.size() - from));
        std::ranges::move(makeWorklistCases(store, options, {begin, end}), std::back_inserter(out));
    }
    return out;
}

WorklistPage makeWorklistPage(CaseStore& store, const QueueOptions& options, const WorklistPageWanted& wanted)
{
    const int most = wanted.most + 1;
    WorklistPage page;
    page.cases = wanted.state ? casesInState(store, options, wanted, most)
                              : makeWorklistCases(store, options, casesOfPage(store, wanted, most));
    page.more = int(page.cases.size()) > wanted.most;
    if (page.more)
        page.cases.pop_back();
    return page;
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

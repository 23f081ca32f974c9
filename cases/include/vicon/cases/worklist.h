#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"
#include "vicon/core/organ.h"

namespace vicon {

/// How far a scan is, or a case with its scans together.
enum class WorkState {
    kept,     ///< not for the pipeline
    refused,  ///< its images make no volume
    queued,
    running,
    done,
    failed,
};
/// "kept", "refused", "queued", "running", "done", "failed".
std::string nameOf(WorkState state);
WorkState workStateOf(JobState state);

/// A scan as the worklist shows it.
struct WorklistScan {
    ScanRecord record;
    WorkState state = WorkState::kept;
    std::string step;     ///< being worked on
    double progress = 0;  ///< 0 to 1
    std::string reason;   ///< why it failed, is kept or refused; the verdict where no organ was found, or not surely
    std::filesystem::path folder;
    std::string quality;     ///< how well it can be read, in a few words; empty where it is not known
    bool adequate = true;    ///< its quality
    bool corrected = false;  ///< by a person; told of scans that cannot be shown
    Organ organ = {};        ///< what it shows

    bool ready() const { return state == WorkState::done && reason.empty(); }  ///< it can be shown
    /// Nothing that can be shown was left by its corrections.
    bool spoiled() const { return state == WorkState::done && !reason.empty() && corrected; }
};

/// A case as the worklist shows it.
struct WorklistCase {
    CaseRecord record;
    WorkState state = WorkState::kept;  ///< failed, running, queued, done, kept, refused: the first of these
    std::string reason;
    double progress = 0;  ///< of its jobs together, 0 to 1
    int markers = 0;
    int reports = 0;       ///< how many were written
    std::string delivery;  ///< of its objects to peers: "3 committed, 1 refused"; empty where none was sent
    std::vector<WorklistScan> scans;
};

/// Which part of the worklist is wanted.
struct WorklistPageWanted {
    int most = 100;
    /// What the reader typed: each the beginning of a part of the patient's name, of ID, accession number, study date
    /// or case id. Those found come in the order of the word that is longest here. Empty: all cases, the newest first.
    std::string words;
    std::string after;                    ///< the last case of the page before; empty: the first page
    std::optional<WorkState> state = {};  ///< only cases that are so; none: whatever they are

    bool operator==(const WorklistPageWanted&) const = default;
};
struct WorklistPage {
    std::vector<WorklistCase> cases;
    bool more = false;  ///< than these
};
/// As quick among a million cases as among ten, but where many are looked through for few that are so.
WorklistPage makeWorklistPage(CaseStore& store, const QueueOptions& options, const WorklistPageWanted& wanted);

/// All of it, the oldest first.
std::vector<WorklistCase> makeWorklist(CaseStore& store, const QueueOptions& options);
WorklistCase makeWorklistCase(CaseStore& store, const QueueOptions& options, const CaseRecord& record);

/// {"cases":[{"id","patient","study_uid","state","scans":[{"id","series_uid","position","state","folder"}]}]} and more
/// keys, as docs/dev/schemas/cases.schema.json has it.
nlohmann::json toJson(const std::vector<WorklistCase>& worklist);

/// Puts the failed jobs of a case back into the queue; spoiled scans as well, without their corrections.
void retryCase(CaseStore& store, const QueueOptions& options, const std::string& case_id);

}  // namespace vicon

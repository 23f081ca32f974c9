#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/bridges.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/known_study.h"
#include "vicon/cases/prior_match.h"
#include "vicon/cases/report_texts.h"
#include "vicon/cases/report_versions.h"
#include "vicon/cases/worklist.h"
#include "vicon/core/corrections.h"
#include "vicon/core/progress.h"

class QWidget;

namespace vicon::viewer {

/// What the report's form needs from rooms it does not know, as below. What takes a Progress throws Error{cancelled}
/// once it is cancelled, and has then kept nothing.
struct ReportServices {
    ReportTexts texts;
    /// What images and steps say of a case.
    std::function<KnownStudy(CaseStore&, const std::string& case_id)> known;
    /// As plain text: the last version that was given out, or the draft while the report is open.
    std::function<std::string(CaseStore&, const std::string& case_id)> text;
    /// The bytes of the PDF of the same.
    std::function<std::string(CaseStore&, const std::string& case_id, Progress&)> pdf;
    std::function<ReportVersion(CaseStore&, const std::string& case_id, Progress&)> sign;
    std::function<void(CaseStore&, const std::string& case_id, const std::string& reason)> amend;
    std::function<void(CaseStore&, const std::string& case_id)> cancel_amendment;
};

/// What the list of earlier reports needs, likewise.
struct PriorServices {
    PriorOptions options;
    std::function<PriorList(CaseStore&, const std::string& case_id)> list;
    /// The scans of a report's study that the store has.
    std::function<std::vector<PriorScan>(CaseStore&, const PriorReport&)> scans;
};

/// What the reading room needs from rooms it does not know; `app` gives it. Each is called on a thread other than the
/// window's, with that thread's connection to the store.
struct ReadingServices {
    StorePlace store;
    std::string receiver;  ///< where a PACS sends studies to, in words
    std::function<WorklistPage(CaseStore&, const WorklistPageWanted&)> worklist;
    /// One case of it; nothing where it is there no more. A case whose window is open need not be on the page shown.
    std::function<std::optional<WorklistCase>(CaseStore&, const std::string& case_id)> worklist_case;
    /// The same again where the worklist is still the same, for that connection; none: the worklist is always read.
    std::function<std::string(CaseStore&)> worklist_version;
    /// A reader opened the case: what is still to be done of it comes first. May be empty.
    std::function<void(CaseStore&, const std::string& case_id)> opened;
    /// Puts the failed jobs of a case back into the queue; spoiled scans as well, without their corrections.
    std::function<void(CaseStore&, const std::string& case_id)> retry;
    /// Fills in a marker's stations and its part of the colon; throws where the point is not in the colon.
    std::function<Marker(CaseStore&, const std::string& case_id, Marker)> place;
    /// Writes a report and returns its file. Throws Error{cancelled} once it is, and has then written nothing.
    std::function<std::filesystem::path(CaseStore&, const std::string& case_id, Progress&)> report;
    std::function<Corrections(CaseStore&, const ScanRecord&)> corrections;
    /// Keeps the second as all corrections of a scan instead of the first, and queues what has to be done again; throws
    /// Error{bad_input} where it has others than the first by now.
    std::function<void(CaseStore&, const ScanRecord&, const Corrections&, const Corrections&)> correct;
    std::function<std::vector<ReviewedBridge>(CaseStore&, const ScanRecord&)> bridges;
    /// Keeps a bridge's review; who and when are filled in where they are empty. None takes it back.
    std::function<void(CaseStore&, const ScanRecord&, const ReviewedBridge&)> review_bridge;
    /// Runs the queue until it is empty or `stop` is set: what was under way then waits in the queue.
    std::function<void(CaseStore&, const std::atomic<bool>& stop)> work;
    /// The change that adds the markers of a file, placed. Throws Error{cancelled} once it is.
    std::function<std::vector<MarkerEdit>(CaseStore&, const std::string& case_id, const std::filesystem::path&,
                                          Progress&)>
        import_markers;
    /// Places all markers of a case anew; returns the ids of those that no longer lie in the colon.
    std::function<std::vector<std::string>(CaseStore&, const std::string& case_id)> renew_places;
    ReportServices reporting;
    PriorServices priors;
};

/// The worklist's window; it opens cases in windows of their own. `case_id` not empty: opens that case at once.
std::unique_ptr<QWidget> makeReadingRoom(const ReadingServices& services, const std::string& case_id = {});

/// Throws Error{no_display} where runReadingRoom() would for want of a screen.
void requireScreen();

/// Shows the reading room until its windows are closed, or `stop` is set. Returns the exit code.
/// Throws Error{no_display} where no window can be shown.
int runReadingRoom(const ReadingServices& services, const std::string& case_id, const std::atomic<bool>& stop);

}  // namespace vicon::viewer

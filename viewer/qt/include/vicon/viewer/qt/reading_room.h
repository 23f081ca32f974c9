#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"

class QWidget;

namespace vicon::viewer {

/// A scan that the reading room may offer.
struct WorklistScanRow {
    ScanRecord record;
    std::string state;  ///< queued, running, done, failed, kept
    std::string step;
    double progress = 0;
    std::string reason;  ///< why it failed, or the pipeline's verdict
    std::filesystem::path folder;
    std::string quality;  ///< how well it can be read, in a few words; empty where it is not known
    bool adequate = true;
    std::string organ = "colon";  ///< what it shows
    bool corrected = false;       ///< by a person; told of scans that cannot be shown

    bool ready() const { return state == "done" && reason.empty(); }  ///< it can be shown
    /// Nothing that can be shown was left by its corrections.
    bool spoiled() const { return state == "done" && !reason.empty() && corrected; }
};

/// A line of the worklist.
struct WorklistRow {
    CaseRecord record;
    std::string state;
    std::string reason;
    double progress = 0;  ///< of its jobs together, 0 to 1
    int markers = 0;
    int reports = 0;  ///< how many were written
    std::vector<WorklistScanRow> scans;
};

/// What a person says about the lumen at a point: it belongs to the colon; it is cut here; the piece here does not
/// belong to the colon.
enum class Correction { add, cut, drop };

/// All that was said about a scan's lumen, in LPS mm.
struct ScanCorrections {
    std::vector<Point3> add, cut, drop;

    std::vector<Point3>& of(Correction kind)
    {
        return kind == Correction::add ? add : kind == Correction::cut ? cut : drop;
    }
    bool operator==(const ScanCorrections&) const = default;
};

/// A gap between two pieces of lumen that the pipeline joined.
struct BridgeRow {
    Point3 from_mm, to_mm;
    double length_mm = 0, confidence = 0;
    bool certain = true;
    std::string reason;
    std::string verdict, by, at;  ///< "confirmed" or "rejected", who and when; empty: nobody has judged it
};

/// What the reading room needs from rooms it does not know; `app` gives it. Each is called on a thread other than the
/// window's, with that thread's connection to the store.
struct ReadingServices {
    std::filesystem::path store;
    std::string receiver;  ///< where a PACS sends studies to, in words
    std::function<std::vector<WorklistRow>(CaseStore&)> worklist;
    /// The same again where the worklist is still the same, for that connection; none: the worklist is always read.
    std::function<std::string(CaseStore&)> worklist_version;
    /// Puts the failed jobs of a case back into the queue; spoiled scans as well, without their corrections.
    std::function<void(CaseStore&, const std::string& case_id)> retry;
    /// Fills in a marker's stations and its part of the colon; throws where the point is not in the colon.
    std::function<Marker(CaseStore&, const std::string& case_id, Marker)> place;
    /// Writes a report and returns its file.
    std::function<std::filesystem::path(CaseStore&, const std::string& case_id)> report;
    std::function<ScanCorrections(CaseStore&, const ScanRecord&)> corrections;
    /// Keeps these as all corrections of a scan, and queues what has to be done again.
    std::function<void(CaseStore&, const ScanRecord&, const ScanCorrections&)> correct;
    std::function<std::vector<BridgeRow>(CaseStore&, const ScanRecord&)> bridges;
    /// Keeps a bridge's verdict; who and when are filled in where they are empty. An empty verdict takes it back.
    std::function<void(CaseStore&, const ScanRecord&, const BridgeRow&)> review_bridge;
    /// Runs the queue until it is empty or `stop` is set: what was under way then waits in the queue.
    std::function<void(CaseStore&, const std::atomic<bool>& stop)> work;
    /// The change that adds the markers of a file, placed.
    std::function<std::vector<MarkerEdit>(CaseStore&, const std::string& case_id, const std::filesystem::path&)>
        import_markers;
};

/// The worklist's window; it opens cases in windows of their own. `case_id` not empty: opens that case at once.
std::unique_ptr<QWidget> makeReadingRoom(const ReadingServices& services, const std::string& case_id = {});

/// Shows the reading room until its windows are closed, or `stop` is set. Returns the exit code.
/// Throws Error{no_display} where no window can be shown.
int runReadingRoom(const ReadingServices& services, const std::string& case_id, const std::atomic<bool>& stop);

}  // namespace vicon::viewer

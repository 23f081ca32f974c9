#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "vicon/cases/case_store.h"
#include "vicon/core/progress.h"
#include "vicon/viewer/scene/known_snapshots.h"

namespace vicon::app {

/// A case's markers in a scan, by station.
std::vector<Marker> markersOf(const ReadCase& read, const ScanRecord& scan);
/// What a picture says about its scan; the page says whose it is, and the heading of the picture which scan's.
viewer::Caption captionOf(const ScanRecord& scan);
/// What the pictures of a report have in common.
viewer::SnapshotRequest reportPicture(viewer::SnapshotView view, const ScanRecord& scan, int width, int height);
/// ... those of a marker.
viewer::SnapshotRequest markerPicture(viewer::SnapshotView view, const ScanRecord& scan, const Marker& marker,
                                      int width, int height);
constexpr int kEndoscopicSide = 600;  ///< printed 144 points wide and less: a printer has 300 pixels to the inch

/// The prepared scans of a report, each read once. What the endoscopic pictures of its markers need is read and made
/// ready on a thread of its own from the beginning, while overviews are drawn.
class ReportScans {
public:
    /// Begins. The environment must not change any more, as a viewer::Display that starts changes it.
    /// @param wanted whether it still is; must outlive it
    ReportScans(CaseStore& store, const ReadCase& read, const Progress& wanted);
    /// Gives up what is under way.
    ~ReportScans();
    ReportScans(const ReportScans&) = delete;
    ReportScans& operator=(const ReportScans&) = delete;

    /// Nothing where it is not prepared (now). Throws as viewer::PreparedScan::open() does.
    const viewer::PreparedScan* find(const std::string& scan_id);
    /// Pictures from before the scan's markers, in the order of markersOf(). Waits, and throws what went wrong. To be
    /// called once for a scan that find() knows and that has markers.
    std::unique_ptr<viewer::KnownSnapshots> sights(const std::string& scan_id);

private:
    struct Scan {
        std::string id;
        std::filesystem::path folder;
        std::vector<viewer::SnapshotRequest> requests;
        std::optional<viewer::PreparedScan> prepared;
        std::promise<std::unique_ptr<viewer::KnownSnapshots>> sights;
    };
    /// Until nobody wants the report, or it is there.
    class StillWanted : public Progress {
    public:
        explicit StillWanted(const Progress& report) : report_(report) {}
        void report(double, std::string_view) override {}
        bool cancelled() const override { return given_up_ || report_.cancelled(); }
        void giveUp() { given_up_ = true; }

    private:
        const Progress& report_;
        std::atomic<bool> given_up_ = false;
    };
    Scan* scanOf(const std::string& scan_id);
    void makeReady();

    std::vector<std::unique_ptr<Scan>> scans_;
    std::mutex mutex_;  ///< of the opening
    StillWanted wanted_;
    std::future<void> making_;
};

}  // namespace vicon::app

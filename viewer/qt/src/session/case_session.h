#pragma once

#include <QImage>
#include <QObject>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "session/open_scan.h"
#include "session/own_store.h"
#include "session/scan_maps.h"
#include "vicon/cases/audit_event.h"
#include "vicon/cases/density_sample.h"
#include "vicon/cases/polyp_size.h"
#include "vicon/cases/store_locks.h"
#include "vicon/viewer/model/marker_history.h"
#include "vicon/viewer/model/plane_size.h"
#include "vicon/viewer/model/wall_distance.h"
#include "vicon/viewer/qt/reading_room.h"
#include "widgets/worker_with.h"

namespace vicon {
class Error;
}

namespace vicon::viewer {

/// A case that is open: its scans and its markers, with one thread that speaks to the database. A change of a marker
/// is shown when it has been saved.
class CaseSession : public QObject {
    Q_OBJECT
public:
    CaseSession(const ReadingServices& services, const WorklistCase& row, QObject* parent);

    const CaseRecord& record() const { return row_.record; }
    /// Those that can be shown: their jobs are done and found a colon.
    const std::vector<ScanRecord>& scans() const { return scans_; }
    /// Where the files of one of them lie.
    std::filesystem::path folderOf(const std::string& scan_id) const;
    /// As the worklist shows the case by now. Returns the scans that can be shown since.
    std::vector<ScanRecord> renew(const WorklistCase& row);
    const std::vector<Marker>& markers() const { return markers_; }
    std::vector<Marker> markersOf(const std::string& scan_id) const;
    /// Nothing when it was deleted.
    std::optional<Marker> marker(const std::string& id) const;

    /// Reads a scan's files; opened() follows, or warned(). The scan beside changes places with the one being read.
    /// @param fresh reads it again, after its files were made anew, or for another way
    /// @param branch of an organ that branches: the way from the root to the end of this one; below 0, or where there
    ///        is no such branch any more: to the farthest tip
    void open(const std::string& scan_id, bool fresh = false, int branch = -1);
    /// What is being read is given up; the scan that is open stays.
    void cancelOpening();
    /// Reads another scan to be shown beside the one being read; besideOpened() follows.
    void openBeside(const std::string& scan_id);
    void closeBeside();
    /// Shows a scan of an earlier examination beside the one being read; besideOpened() follows.
    void openPriorBeside(const CaseRecord& record, const ScanRecord& scan, const std::filesystem::path& folder);
    /// What is beside is of an earlier examination: it is looked at, not marked.
    bool besideIsPrior() const { return beside_ && beside_->record.case_id != row_.record.id; }
    OpenScan* beside() const { return beside_.get(); }
    /// The scan of this case that is beside, or is being read to be; empty: none is.
    std::string besideWanted() const;
    std::shared_ptr<OpenScan> sharedBeside() const { return beside_; }
    /// The stations of one open scan in another of the same patient.
    /// Only where haveSamePlaces().
    StationMap mapBetween(const OpenScan& from, const OpenScan& to) { return maps_.between(from, to); }
    OpenScan* scan() const { return scan_.get(); }
    std::shared_ptr<OpenScan> sharedScan() const { return scan_; }
    /// The one that is read or the one beside it; nothing: neither is.
    std::shared_ptr<OpenScan> openScan(const std::string& id) const;

    void addMarker(const Marker& marker);
    /// @param what is said when it is saved; empty: that it is
    void changeMarker(const Marker& before, const Marker& after, bool moved, const QString& what = {});
    void removeMarker(const Marker& marker);
    void pairMarkers(const Marker& a, const Marker& b);
    /// Takes it from those that it is paired with, on both sides.
    void partMarkers(const Marker& marker);
    /// The markers of a file join those of the case: all in one step, or none.
    void loadMarkers(const std::filesystem::path& file);
    /// Those of a file that is being loaded are not taken; saved() says so.
    void giveUpLoadingMarkers();
    /// All markers of the case, as loadMarkers() and `vicon markers --import` take them.
    void saveMarkers(const std::filesystem::path& file);
    void undo();
    void redo();
    std::optional<StepNumber> toUndo() const { return to_undo_; }
    std::optional<StepNumber> toRedo() const { return to_redo_; }
    /// A change is on its way to the database; until then the markers shown may be old ones.
    bool busy() const { return edits_under_way_ > 0; }
    /// Looks whether another reader changed something.
    void refresh();
    /// The scan's skeleton was made anew: its markers get their stations on it, now and after an undo. What cannot be
    /// placed any more is warned of, and stays as it is. @param what is said then
    void placeAnew(const QString& what);
    /// reportWritten() follows, or warned(). Also when the window closes meanwhile.
    void writeReport();
    /// What is being written is given up; saved() says so. False where nothing is.
    bool giveUpReport();
    /// Into the audit trail.
    void log(AuditEvent event, const std::string& scan_id, const QString& words);
    /// Between two points of the wall of a scan that is open, seen from `eye`; measured() follows, or notMeasured().
    /// @param request which one this is, of all that are measured and outlined
    void measure(int request, const std::string& scan_id, Point3 from, Point3 to, Point3 eye);
    /// The polyp of a scan that is open under a point of the wall or around one in its tissue; outlined() follows, or
    /// notMeasured().
    void outlinePolyp(int request, const std::string& scan_id, Point3 at);
    /// Of the open scan's tissue around a point, below a circled wall where there is one; biopsied() follows, or
    /// warned().
    void takeBiopsy(Point3 centre, double radius_mm, const std::optional<CircledWall>& wall);
    /// What is being measured, outlined or sampled is given up: of one request, or all.
    void giveUpMeasuring(int request);
    void giveUpMeasuring();
    /// What was measured of a marker of a scan that is open, as a picture; measuresDrawn() follows where there is any.
    void drawMeasures(const Marker& marker, int side_px);
    /// Keeps a picture in the case's folder, "pictures/1.png" and on.
    void savePicture(const QImage& picture);
    /// A name for a film beside the pictures; filmNamed() follows, empty after warned() where there can be none.
    void nameFilm();

signals:
    void opened();
    /// How far open() is.
    void opening(int done, int of);
    void openingFailed();
    void besideOpened();
    void besideClosed();
    void markersChanged();
    /// A person must decide something else about the case than before.
    void flagsChanged();
    void busyChanged(bool busy);
    void saved(const QString& what);
    void warned(const QString& message);
    void measured(int request, const vicon::viewer::WallDistance& size, const std::optional<vicon::PlaneSize>& plane);
    void outlined(int request, const vicon::PolypOutline& outline);
    /// It could not be; warned() says why.
    void notMeasured(int request);
    /// All requests, as another scan is read.
    void measuringGivenUp();
    void biopsied(const vicon::DensitySample& biopsy);
    void measuresDrawn(const QString& marker, const vicon::viewer::Picture& picture);
    void filmNamed(const QString& file);
    void reportWritten(const QString& file);

private:
    /// What is in the database, and what this reader did to it.
    struct Books {
        Books(StorePlace place, const std::string& case_id) : store(std::move(place)), history(case_id) {}

        OwnStore store;
        std::optional<CaseInUse> in_use;
        MarkerHistory history;
        bool skeleton_is_new = false;  ///< what the history remembers has stations of an older one
    };
    using Edit = std::function<void(Books&)>;
    void edit(const QString& what, Edit work);
    void edited();
    void takeBack(const QString& what, void (MarkerHistory::*step)(CaseStore&));
    std::filesystem::path newPicture(CaseStore& store, const std::string& extension) const;
    std::string messageFor(CaseStore& store, const Error& error) const;

    using Opened = std::function<void(std::shared_ptr<OpenScan>)>;
    /// A scan of a case, and where its files lie.
    struct ScanFiles {
        CaseRecord record;
        ScanRecord scan;
        std::filesystem::path folder;
    };
    /// Of the case that is read; nothing where it has no such scan.
    std::optional<ScanFiles> filesOf(const std::string& scan_id) const;
    void readOn(const PreparedScan& files);
    using Measuring = std::function<Worker::Work(const Progress& wanted)>;
    void startMeasuring(int request, const std::shared_ptr<OpenScan>& scan, Measuring work);
    /// What is measured of the scan that was read, and drawn of it, does not hold up the next one.
    void giveUpMeasures();
    /// Reads a scan's files on the loader's thread. `work` is the one that reads, or the one beside.
    void load(const char* work, const ScanFiles& files, int branch, Opened then);
    void loadBeside();
    /// The scan is read from now on. Never is one scan beside itself: that of before takes its place.
    void lead(std::shared_ptr<OpenScan> made);
    void besideNotRead(const std::string& scan_id);

    const ReadingServices services_;
    WorklistCase row_;
    std::vector<ScanRecord> scans_;
    std::vector<Marker> markers_;
    std::shared_ptr<OpenScan> scan_;
    std::shared_ptr<OpenScan> beside_;
    std::string wanted_scan_;
    std::optional<ScanFiles> wanted_beside_;
    std::optional<StepNumber> to_undo_, to_redo_;
    ScanMaps maps_;
    bool markers_known_ = false;
    int edits_under_way_ = 0;
    std::set<int> measuring_;                 ///< the requests
    std::shared_ptr<Wanted> report_wanted_;   ///< while it is written
    std::shared_ptr<Wanted> loading_wanted_;  ///< of the file of markers loaded last
    Worker reads_on_{this};
    Worker loader_{this};      // ends before reads_on_, to which it speaks
    WorkerWith<Books> books_;  // last: it ends first
};

}  // namespace vicon::viewer

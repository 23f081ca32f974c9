#pragma once

#include <QObject>
#include <map>

#include "session/open_scan.h"
#include "vicon/viewer/model/unseen.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// What this reader has reviewed of a scan of the case, now and in earlier sessions.
struct ReviewedScan {
    ScanRecord scan;
    double seen_mm2 = 0, whole_mm2 = 0;  ///< of its wall; 0 and 0 where its files cannot be read
    int missed = 0;                      ///< regions of kMissedRegion_mm2 and more

    bool readable() const { return whole_mm2 > 0; }
    bool begun() const { return seen_mm2 > 0; }
};

/// A scan of the case: where its files lie and, where it is open, what is known of it by now.
struct ScanToReview {
    ScanRecord scan;
    std::filesystem::path folder;
    std::shared_ptr<OpenScan> open;
};

/// Finds what was not seen, and keeps what was: for each reader, in the case's folder.
class CoverageKeeper : public QObject {
    Q_OBJECT
public:
    explicit CoverageKeeper(QObject* parent);

    /// Takes back what this reader had seen of a scan in earlier sessions; on a thread that may read files.
    /// @param scan_folder in the case's folder
    static void restore(ScanCoverage& seen, const std::filesystem::path& scan_folder);

    /// found() follows, unless they are looked for anew before: a list that the reader goes through is not replaced by
    /// one that was asked for earlier.
    void findUnseen(std::shared_ptr<OpenScan> scan, double least_mm2);
    /// summedUp() follows, with each of these scans; what save() was given before is counted.
    void sumUp(std::vector<ScanToReview> scans);
    /// Writes what was seen, unless it is written already.
    void save(std::shared_ptr<OpenScan> scan);

signals:
    void found(const std::vector<vicon::viewer::UnseenPatch>& patches, std::shared_ptr<vicon::viewer::OpenScan> scan);
    void summedUp(const std::vector<vicon::viewer::ReviewedScan>& scans);
    void failed(const QString& message);

private:
    using Written = std::map<std::filesystem::path, std::string>;  ///< by file, what is in it
    WorkerWith<Written> worker_{this};
};

}  // namespace vicon::viewer

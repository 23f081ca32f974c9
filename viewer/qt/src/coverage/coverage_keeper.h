#pragma once

#include <QObject>
#include <map>

#include "session/open_scan.h"
#include "vicon/viewer/model/unseen.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

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
    /// Writes what was seen, unless it is written already.
    void save(std::shared_ptr<OpenScan> scan);

signals:
    void found(const std::vector<vicon::viewer::UnseenPatch>& patches, std::shared_ptr<vicon::viewer::OpenScan> scan);
    void failed(const QString& message);

private:
    int latest_search_ = 0;                                        // by the owner's thread
    using Written = std::map<std::filesystem::path, std::string>;  ///< by file, what is in it
    WorkerWith<Written> worker_{this};
};

}  // namespace vicon::viewer

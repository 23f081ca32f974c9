#pragma once

#include <memory>

#include "case_session.h"
#include "vicon/viewer/scene/reading_pictures.h"
#include "worker.h"

namespace vicon::viewer {

/// Draws on a thread of its own, which holds the OpenGL context; what is asked for while it draws is answered with the
/// newest wish only.
class Studio : public QObject {
    Q_OBJECT
public:
    Studio();
    ~Studio() override;

    void drawEndoscopic(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place,
                        bool still);
    void drawOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place);

signals:
    void endoscopicDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::Pose& pose,
                         const vicon::viewer::Lens& lens);
    void overviewDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::PlaneView& view);
    void failed(const QString& message);

private:
    ReadingPictures& picturesOf(const std::shared_ptr<OpenScan>& scan);

    std::shared_ptr<OpenScan> scan_;             // the worker's
    std::unique_ptr<ReadingPictures> pictures_;  // the worker's
    Worker worker_;
};

}  // namespace vicon::viewer

#include "studio.h"

namespace vicon::viewer {

Studio::Studio()
{
    connect(&worker_, &Worker::failed, this, &Studio::failed);
}

Studio::~Studio()
{
    worker_.postAlways([this]() -> Worker::Work {  // the context ends on the thread that it belongs to
        pictures_.reset();
        return {};
    });
}

ReadingPictures& Studio::picturesOf(const std::shared_ptr<OpenScan>& scan)
{
    if (!pictures_ || scan_ != scan) {
        pictures_.reset();
        pictures_ = std::make_unique<ReadingPictures>(scan->files);
        scan_ = scan;
    }
    return *pictures_;
}

void Studio::drawEndoscopic(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place,
                            bool still)
{
    worker_.post("endoscopic", [this, scan = std::move(scan), request, place, still]() -> Worker::Work {
        auto picture = std::make_shared<Picture>(picturesOf(scan).endoscopic(request, place, still));
        return [this, picture, pose = place.pose, lens = Lens{request.view_angle_deg, request.width, request.height}] {
            emit endoscopicDrawn(*picture, pose, lens);
        };
    });
}

void Studio::drawOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    worker_.post("overview", [this, scan = std::move(scan), request, place]() -> Worker::Work {
        auto drawn = std::make_shared<ReadingPictures::Overview>(picturesOf(scan).overview(request, place));
        return [this, drawn] { emit overviewDrawn(drawn->picture, drawn->view); };
    });
}

}  // namespace vicon::viewer

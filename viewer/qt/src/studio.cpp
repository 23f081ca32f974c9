#include "studio.h"

namespace vicon::viewer {
namespace {
// Counting costs as much as drawing; at the fastest flight of 100 mm/s the eye moves a centimetre meanwhile.
constexpr std::chrono::milliseconds kBetweenCounts(100);
}  // namespace

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

void Studio::drawEndoscopic(std::shared_ptr<OpenScan> scan, const Wish& wish)
{
    worker_.post("endoscopic", [this, scan = std::move(scan), wish]() -> Worker::Work {
        const SnapshotRequest& request = wish.request;
        auto picture = std::make_shared<Picture>(
            picturesOf(scan).endoscopic(request, wish.place, wish.still, wish.paint_seen ? &scan->seen : nullptr));
        if (wish.count_seen && (wish.still || std::chrono::steady_clock::now() - counted_ > kBetweenCounts))
            worker_.post("seen", [this]() -> Worker::Work {
                countSeen();
                return [this] { emit seenChanged(); };
            });
        return [this, picture, pose = wish.place.pose,
                lens = Lens{request.view_angle_deg, request.width, request.height}] {
            emit endoscopicDrawn(*picture, pose, lens);
        };
    });
}

void Studio::countSeen()
{
    counted_ = std::chrono::steady_clock::now();
    if (pictures_)
        pictures_->countSeen(scan_->seen);
}

void Studio::drawOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place)
{
    worker_.post("overview", [this, scan = std::move(scan), request, place]() -> Worker::Work {
        auto drawn = std::make_shared<ReadingPictures::Overview>(picturesOf(scan).overview(request, place));
        return [this, drawn] { emit overviewDrawn(drawn->picture, drawn->view); };
    });
}

}  // namespace vicon::viewer

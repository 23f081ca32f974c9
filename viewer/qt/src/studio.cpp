#include "studio.h"

#include <thread>

namespace vicon::viewer {
namespace {
// Counting costs as much as drawing; at the fastest flight of 100 mm/s the eye moves a centimetre meanwhile.
constexpr std::chrono::milliseconds kBetweenCounts(100);
constexpr std::chrono::milliseconds kBetweenLooks(1);
}  // namespace

Studio::Studio()
{
    connect(&worker_, &Worker::failed, this, &Studio::failed);
}

// Each of the workers speaks to the other: none is destroyed before both have ended.
Studio::~Studio()
{
    end();
    while (!worker_.ended() || !sight_worker_.ended())
        std::this_thread::sleep_for(kBetweenLooks);
}

void Studio::end()
{
    worker_.postAlways([this]() -> Worker::Work {
        pictures_.clear();
        return {};
    });
    sight_worker_.end();
    worker_.end();
}

ReadingPictures& Studio::picturesOf(const std::shared_ptr<OpenScan>& scan)
{
    pictures_.remove_if([](const Pictures& some) { return some.of.expired(); });
    for (Pictures& some : pictures_)
        if (some.of.lock() == scan)
            return *some.pictures;
    pictures_.push_back({scan, std::make_unique<ReadingPictures>(scan->files), {}});
    if (!pictures_.back().pictures->hasOpenGl())
        emit withoutOpenGl();  // from this thread: it arrives in the window's own
    findSightLines(scan);
    return *pictures_.back().pictures;
}

void Studio::findSightLines(const std::shared_ptr<OpenScan>& scan)
{
    sight_worker_.post("sight lines " + scan->record.id,
                       [this, files = scan->files, of = std::weak_ptr(scan)]() -> Worker::Work {
                           if (of.expired())
                               return {};
                           auto visibility = std::make_shared<const CellVisibility>(files);
                           worker_.post("sight lines", [this, visibility, of]() -> Worker::Work {
                               for (Pictures& some : pictures_)
                                   if (some.of.lock() == of.lock())
                                       some.pictures->chooseBy(visibility);
                               return {};
                           });
                           return {};
                       });
}

void Studio::drawEndoscopic(std::shared_ptr<OpenScan> scan, const Wish& wish)
{
    draw(Which::leading, std::move(scan), wish);
}

void Studio::drawBeside(std::shared_ptr<OpenScan> scan, const Wish& wish)
{
    draw(Which::beside, std::move(scan), wish);
}

void Studio::draw(Which which, std::shared_ptr<OpenScan> scan, const Wish& wish)
{
    const char* name = which == Which::leading ? "endoscopic" : "beside";
    worker_.post(name, [this, which, scan = std::move(scan), wish]() -> Worker::Work {
        const SnapshotRequest& request = wish.request;
        auto picture = std::make_shared<Picture>(
            picturesOf(scan).endoscopic(request, wish.place, wish.still,
                                        {wish.paint_seen ? &scan->seen : nullptr, wish.structure, wish.lamp_reach_mm}));
        if (wish.count_seen)
            worker_.post(which == Which::leading ? "seen" : "seen beside",
                         [this, scan, always = wish.still]() -> Worker::Work {
                             countSeen(scan, always);
                             return [this] { emit seenChanged(); };
                         });
        const Lens lens{request.view_angle_deg, request.width, request.height};
        const auto signal = which == Which::leading ? &Studio::endoscopicDrawn : &Studio::besideDrawn;
        return [this, picture, signal, shown = Shown{scan, wish.place, lens}] { emit(this->*signal)(*picture, shown); };
    });
}

void Studio::countSeen(const std::shared_ptr<OpenScan>& scan, bool always)
{
    for (Pictures& some : pictures_) {
        const auto now = std::chrono::steady_clock::now();
        if (some.of.lock() != scan || (!always && now - some.counted < kBetweenCounts))
            continue;
        some.pictures->countSeen(scan->seen);
        some.counted = now;
    }
}

void Studio::film(std::shared_ptr<OpenScan> scan, const Wish& wish, Heading heading, std::shared_ptr<Film> film,
                  bool last)
{
    worker_.post("film", [this, scan = std::move(scan), wish, heading, film = std::move(film), last]() -> Worker::Work {
        const ViewPose view = poseAtStation(scan->files.frames(), scan->lumen, wish.place.station_mm, heading);
        const SnapshotResult place{view.pose, wish.place.station_mm, view.clearance_mm, true};
        film->add(
            picturesOf(scan).endoscopic(wish.request, place, false, {nullptr, wish.structure, wish.lamp_reach_mm}));
        if (last)
            film->finish();
        return [this, film, last] { emit filmed(film, last); };
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

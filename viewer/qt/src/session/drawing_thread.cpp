#include "session/drawing_thread.h"

#include <thread>
#include <utility>

#include "vicon/viewer/model/acquired_wall.h"

namespace vicon::viewer {
namespace {
// Counting costs as much as drawing; at the fastest flight of 100 mm/s the eye moves a centimetre meanwhile.
constexpr std::chrono::milliseconds kBetweenCounts(100);
constexpr std::chrono::milliseconds kBetweenLooks(1);
constexpr double kReach_mm = 500;  // of a click into the endoscopic view
}  // namespace

ChosenPeel ChosenPeel::of(const PeelRequest& peel)
{
    if (peel.preset.empty())
        return {};
    return {peel.preset, peel.options.offset_mm, peel.middle_only, peel.over_surface};
}

std::optional<Point3> ShownPicture::wallAt(Pixel at) const
{
    const Vector3 ray = rayThrough(place.pose, lens, at);
    const auto far_mm = distanceToWall_mm(ray);
    return far_mm ? std::optional(place.pose.eye_mm + ray * *far_mm) : std::nullopt;
}

std::optional<double> ShownPicture::distanceToWall_mm(Vector3 ray) const
{
    const auto of = scan.lock();
    if (!of)
        return std::nullopt;
    const Point3 eye_mm = place.pose.eye_mm;
    return acquired ? distanceToAcquiredWall_mm(of->files.volume(), of->files.gasEnds_hu(), of->lumen, eye_mm, ray,
                                                kReach_mm)
                    : viewer::distanceToWall_mm(of->lumen, eye_mm, ray, kReach_mm);
}

DrawingThread::DrawingThread(QObject* parent) : QObject(parent)
{
    connect(worker_.worker(), &Worker::failed, this, &DrawingThread::failed);
}

// Each of the workers speaks to the other: none is destroyed before both have ended.
DrawingThread::~DrawingThread()
{
    end();
    while (!worker_.ended() || !sight_worker_.ended())
        std::this_thread::sleep_for(kBetweenLooks);
}

void DrawingThread::end()
{
    worker_.postAlways([](AllPictures& all) -> Worker::Work {
        all.clear();
        return {};
    });
    sight_worker_.end();
    worker_.end();
}

void DrawingThread::scanChanged()
{
    for (const char* name : {kEndoscopicWork, kBesideWork, kMissedWork, kCubeWork, kOverviewWork, kBesideOverviewWork})
        worker_.giveUp(name);
    const std::lock_guard lock(cube_mutex_);
    cube_wanted_.reset();
}

ReadingPictures& DrawingThread::picturesOf(AllPictures& all, const std::shared_ptr<OpenScan>& scan)
{
    all.remove_if([](const ScanPictures& some) { return some.of.expired(); });
    for (ScanPictures& some : all)
        if (some.of.lock() == scan)
            return *some.pictures;
    all.push_back({scan, std::make_unique<ReadingPictures>(scan->files), {}});
    if (!all.back().pictures->hasOpenGl())
        emit withoutOpenGl();  // from this thread: it arrives in the window's own
    findSightLines(scan);
    return *all.back().pictures;
}

void DrawingThread::findSightLines(const std::shared_ptr<OpenScan>& scan)
{
    sight_worker_.postTask(
        "sight lines " + scan->record.id,
        [this, files = scan->files, of = std::weak_ptr(scan)](const Progress& wanted) -> Worker::Work {
            if (of.expired())
                return {};
            files.openness(&wanted);
            worker_.post("shade", [this](AllPictures&) -> Worker::Work { return [this] { emit wallShaded(); }; });
            auto visibility =
                std::make_shared<const CellVisibility>(files, CellVisibility::Means::gates_and_sight_lines, &wanted);
            worker_.post("sight lines", [visibility, of](AllPictures& all) -> Worker::Work {
                for (ScanPictures& some : all)
                    if (some.of.lock() == of.lock())
                        some.pictures->chooseBy(visibility);
                return {};
            });
            files.tagging(&wanted);
            worker_.post("shade", [this](AllPictures&) -> Worker::Work { return [this] { emit wallShaded(); }; });
            return {};
        });
}

void DrawingThread::drawEndoscopic(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request)
{
    draw(Which::leading, std::move(scan), request);
}

void DrawingThread::drawBeside(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request)
{
    draw(Which::beside, std::move(scan), request);
}

void DrawingThread::draw(Which which, std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request)
{
    const char* name = which == Which::leading ? kEndoscopicWork : kBesideWork;
    if (std::exchange(still_asked_[std::size_t(which)], request.still) && !request.still)
        worker_.giveUp(name);  // the eye moves on; while it moves, each picture that was begun is shown
    worker_.post(
        name, [this, which, scan = std::move(scan), request](AllPictures& all, const Progress& wanted) -> Worker::Work {
            const SnapshotRequest& snapshot = request.snapshot;
            const bool shaded = !snapshot.wall.ambient_occlusion || scan->files.hasOpenness();
            auto picture = std::make_shared<Picture>(
                picturesOf(all, scan).endoscopic(snapshot, request.place, request.still,
                                                 {request.paint_seen ? &scan->coverage : nullptr, request.structure,
                                                  request.lamp_factor, request.missed.get(), true, &wanted}));
            if (request.count_seen)
                worker_.post(which == Which::leading ? "seen" : "seen beside",
                             [this, scan, always = request.still](AllPictures& drawn) -> Worker::Work {
                                 if (!countSeen(drawn, scan, always))
                                     return {};
                                 return [this] { emit seenChanged(); };
                             });
            const Lens lens{snapshot.view_angle_deg, snapshot.width, snapshot.height};
            const auto signal = which == Which::leading ? &DrawingThread::endoscopicDrawn : &DrawingThread::besideDrawn;
            return [this, picture, signal,
                    shown = ShownPicture{scan, request.place, lens, ChosenPeel::of(snapshot.peel), shaded,
                                         request.snapshot.wall.acquired}] { emit(this->*signal)(*picture, shown); };
        });
}

void DrawingThread::drawFinding(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request,
                                const QString& finding)
{
    worker_.post(
        "finding",
        [this, scan = std::move(scan), request, finding](AllPictures& all, const Progress& wanted) -> Worker::Work {
            auto picture = std::make_shared<Picture>(picturesOf(all, scan).endoscopic(
                request.snapshot, request.place, true, {nullptr, false, request.lamp_factor, nullptr, false, &wanted}));
            return [this, picture, finding] { emit findingDrawn(finding, *picture); };
        });
}

void DrawingThread::drawMissed(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, const MissedRow& row)
{
    worker_.post(
        kMissedWork,
        [this, scan = std::move(scan), request, row](AllPictures& all, const Progress& wanted) -> Worker::Work {
            auto picture = std::make_shared<Picture>(picturesOf(all, scan).endoscopic(
                request.snapshot, request.place, true,
                {nullptr, false, request.lamp_factor, request.missed.get(), false, &wanted}));
            return [this, picture, row, scan] { emit missedDrawn(row, *picture, scan); };
        });
}

bool DrawingThread::countSeen(AllPictures& all, const std::shared_ptr<OpenScan>& scan, bool always)
{
    for (ScanPictures& some : all) {
        const auto now = std::chrono::steady_clock::now();
        if (some.of.lock() != scan || (!always && now - some.counted < kBetweenCounts))
            continue;
        some.pictures->countSeen(scan->coverage, std::chrono::duration<double>(now.time_since_epoch()).count());
        some.counted = now;
        return true;
    }
    return false;
}

void DrawingThread::film(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, Heading heading,
                         std::shared_ptr<Film> film, bool last)
{
    worker_.post(kFilmWork,
                 [this, scan = std::move(scan), request, heading, film = std::move(film), last](
                     AllPictures& all, const Progress& wanted) -> Worker::Work {
                     try {
                         addTo(*film, scan, request, heading, all, wanted);
                         if (last)
                             film->finish();
                     } catch (const std::exception& e) {
                         wanted.check();  // that of one that was cancelled is no failure
                         return [this, film, message = QString(e.what())] { emit filmFailed(film, message); };
                     }
                     return [this, film, last] { emit filmed(film, last); };
                 });
}

void DrawingThread::addTo(Film& film, const std::shared_ptr<OpenScan>& scan, const EndoscopicRequest& request,
                          Heading heading, AllPictures& all, const Progress& wanted)
{
    const ViewPose view = poseAtStation(scan->files.frames(), scan->lumen, request.place.station_mm, heading);
    const SnapshotResult place{view.pose, request.place.station_mm, view.clearance_mm, true};
    film.add(picturesOf(all, scan).endoscopic(
        request.snapshot, place, false, {nullptr, request.structure, request.lamp_factor, nullptr, false, &wanted}));
}

void DrawingThread::drawOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request,
                                 const SnapshotResult& place, bool still)
{
    drawOverview(kOverviewWork, std::move(scan), request, place, still);
}

void DrawingThread::drawBesideOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request,
                                       const SnapshotResult& place, bool still)
{
    drawOverview(kBesideOverviewWork, std::move(scan), request, place, still);
}

void DrawingThread::drawOverview(const char* work, std::shared_ptr<OpenScan> scan, const SnapshotRequest& request,
                                 const SnapshotResult& place, bool still)
{
    worker_.post(work,
                 [this, scan = std::move(scan), request, place, still](AllPictures& all,
                                                                       const Progress& wanted) -> Worker::Work {
                     auto drawn = std::make_shared<ReadingPictures::Overview>(
                         picturesOf(all, scan).overview(request, place, &scan->coverage, still, &wanted));
                     return [this, drawn, shown = ShownProjection{scan, place.pose.eye_mm, drawn->view}] {
                         emit overviewDrawn(drawn->picture, shown);
                     };
                 });
}

}  // namespace vicon::viewer

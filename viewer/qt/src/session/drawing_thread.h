#pragma once

#include <array>
#include <chrono>
#include <list>
#include <memory>
#include <mutex>

#include "session/open_scan.h"
#include "vicon/viewer/scene/film.h"
#include "vicon/viewer/scene/reading_pictures.h"
#include "widgets/worker_with.h"

namespace vicon::viewer {

/// An endoscopic picture: what is in it, and what is done about the wall that it shows.
struct EndoscopicRequest {
    SnapshotRequest snapshot;
    SnapshotResult place;
    bool still = true;
    bool count_seen = true;   ///< it is shown to somebody; while moving, some pictures are counted
    bool paint_seen = false;  ///< what was seen in earlier passes
    bool structure = false;   ///< cells coloured, gates drawn, what is drawn counted
    double lamp_factor = 1;   ///< of the lamp's usual reach
    std::shared_ptr<const std::vector<std::uint8_t>> missed = {};  ///< of each triangle, 1 where it is tinted
};

/// Where the picture of a missed region belongs.
struct MissedRow {
    int list = 0;    ///< which of the lists that were made
    int region = 0;  ///< its row
};

/// The look below the wall as a reader chooses it.
struct ChosenPeel {
    std::string preset = {};  ///< empty: none
    double offset_mm = 0;
    bool middle_only = false, over_surface = false;

    static ChosenPeel of(const PeelRequest& peel);
    bool operator==(const ChosenPeel&) const = default;
};

/// What a picture that is shown was made of: a click into it means that place, wherever the eye is by then.
struct ShownPicture {
    std::weak_ptr<OpenScan> scan;
    SnapshotResult place;
    Lens lens;
    ChosenPeel peel = {};
    bool shaded = false;    ///< with the ambient occlusion that was asked for; it comes a little later than the first
    bool acquired = false;  ///< the wall as acquired: fluid and stool stand

    /// The place on the wall that a pixel shows: on the one that the picture was made of. Nothing where it shows none.
    std::optional<Point3> wallAt(Pixel at) const;
    /// The same from the picture's eye along a ray, as a distance.
    std::optional<double> distanceToWall_mm(Vector3 ray) const;
    bool isOf(const std::shared_ptr<OpenScan>& which) const { return which && scan.lock() == which; }
};

/// What a projection that is shown was made of.
struct ShownProjection {
    std::weak_ptr<OpenScan> scan;
    Point3 eye_mm;  ///< where it marks the eye
    PlaneView view;

    bool isOf(const std::shared_ptr<OpenScan>& which) const { return which && scan.lock() == which; }
};

/// Draws on a thread of its own, which holds the OpenGL context; what is asked for while it draws is answered with the
/// newest request only.
class DrawingThread : public QObject {
    Q_OBJECT
public:
    explicit DrawingThread(QObject* parent);
    ~DrawingThread() override;

    /// The contexts end on the thread that they belong to; nothing is drawn after that.
    void end();
    /// What is drawn of the scan that was read is no longer wanted: another one's pictures do not wait for it.
    void scanChanged();

    void drawEndoscopic(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request);
    /// The same of the other scan; besideDrawn() follows.
    void drawBeside(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request);
    /// @param still what was reviewed is painted as it is now
    void drawOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place,
                      bool still);
    /// The same of the other scan; overviewDrawn() follows, of it.
    void drawBesideOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place,
                            bool still);
    /// All around the eye, face by face, so that the other pictures do not wait for all six; cubeDrawn() follows unless
    /// another cube is asked for meanwhile.
    void drawCube(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request);
    /// What a finding looks like, for the report's form; findingDrawn() follows.
    void drawFinding(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, const QString& finding);
    /// What a missed region looks like, for its list; missedDrawn() follows.
    void drawMissed(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, const MissedRow& row);
    /// A picture of a film, looking along the path from the request's station; filmed() follows, or filmFailed().
    /// @param last the film is finished with it
    void film(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, Heading heading,
              std::shared_ptr<Film> film, bool last);
    /// The picture of a film that is being drawn is no longer wanted.
    void giveUpFilm() { worker_.giveUp(kFilmWork); }

signals:
    void filmed(const std::shared_ptr<vicon::viewer::Film>& film, bool finished);
    void filmFailed(const std::shared_ptr<vicon::viewer::Film>& film, const QString& message);
    void endoscopicDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::ShownPicture& shown);
    void besideDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::ShownPicture& shown);
    void overviewDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::ShownProjection& shown);
    void cubeDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::ShownPicture& shown);
    void findingDrawn(const QString& finding, const vicon::viewer::Picture& picture);
    void missedDrawn(const vicon::viewer::MissedRow& row, const vicon::viewer::Picture& picture,
                     const std::shared_ptr<vicon::viewer::OpenScan>& of);
    void seenChanged();
    /// The wall can be drawn with ambient occlusion from now on.
    void wallShaded();
    /// The pictures of a scan that has just been opened are made without it.
    void withoutOpenGl();
    void failed(const QString& message);

private:
    enum class Which { leading, beside };
    // What work is called.
    static constexpr const char *kEndoscopicWork = "endoscopic", *kBesideWork = "beside", *kMissedWork = "missed",
                                *kCubeWork = "cube", *kOverviewWork = "overview",
                                *kBesideOverviewWork = "overview beside", *kFilmWork = "film";
    struct ScanPictures {
        std::weak_ptr<OpenScan> of;
        std::unique_ptr<ReadingPictures> pictures;
        std::chrono::steady_clock::time_point counted;
    };
    using AllPictures = std::list<ScanPictures>;

    /// A cube, some of its faces drawn.
    struct Cube;
    void drawFaces();
    void drawFace(Cube& cube, AllPictures& all, const Progress& wanted);
    Worker::Work finished(const std::shared_ptr<Cube>& cube);
    void draw(Which which, std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request);
    void addTo(Film& film, const std::shared_ptr<OpenScan>& scan, const EndoscopicRequest& request, Heading heading,
               AllPictures& all, const Progress& wanted);
    void drawOverview(const char* work, std::shared_ptr<OpenScan> scan, const SnapshotRequest& request,
                      const SnapshotResult& place, bool still);
    ReadingPictures& picturesOf(AllPictures& all, const std::shared_ptr<OpenScan>& scan);
    /// In the picture drawn last; while moving not in every one.
    /// False where that was done a moment ago.
    static bool countSeen(AllPictures& all, const std::shared_ptr<OpenScan>& scan, bool always);
    /// Finds the openness and the lines of sight of a scan whose pictures have been begun; until then gates choose what
    /// is drawn.
    void findSightLines(const std::shared_ptr<OpenScan>& scan);

    std::array<bool, 2> still_asked_{};  // of Which: the picture asked for last, which may take long
    std::mutex cube_mutex_;
    std::shared_ptr<Cube> cube_wanted_;  // the newest
    WorkerWith<AllPictures> worker_{this};
    Worker sight_worker_{this};  // ends before worker_, to which it speaks
};

}  // namespace vicon::viewer

#pragma once

#include <chrono>
#include <list>
#include <memory>

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
};

/// What a picture that is shown was made of: a click into it means that place, wherever the eye is by then.
struct ShownPicture {
    std::weak_ptr<OpenScan> scan;
    SnapshotResult place;
    Lens lens;
    std::string peel = {};  ///< the look below the wall; empty: none
    bool shaded = false;    ///< with the ambient occlusion that was asked for; it comes a little later than the first

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

    void drawEndoscopic(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request);
    /// The same of the other scan; besideDrawn() follows.
    void drawBeside(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request);
    void drawOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place);
    /// What a finding looks like, for the report's form; findingDrawn() follows.
    void drawFinding(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, const QString& finding);
    /// A picture of a film, looking along the path from the request's station; filmed() follows.
    /// @param last the film is finished with it
    void film(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, Heading heading,
              std::shared_ptr<Film> film, bool last);

signals:
    void filmed(const std::shared_ptr<vicon::viewer::Film>& film, bool finished);
    void endoscopicDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::ShownPicture& shown);
    void besideDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::ShownPicture& shown);
    void overviewDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::PlaneView& view,
                       const std::shared_ptr<vicon::viewer::OpenScan>& of);
    void findingDrawn(const QString& finding, const vicon::viewer::Picture& picture);
    void seenChanged();
    /// The wall can be drawn with ambient occlusion from now on.
    void wallShaded();
    /// The pictures of a scan that has just been opened are made without it.
    void withoutOpenGl();
    void failed(const QString& message);

private:
    enum class Which { leading, beside };
    struct ScanPictures {
        std::weak_ptr<OpenScan> of;
        std::unique_ptr<ReadingPictures> pictures;
        std::chrono::steady_clock::time_point counted;
    };
    using AllPictures = std::list<ScanPictures>;

    void draw(Which which, std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request);
    ReadingPictures& picturesOf(AllPictures& all, const std::shared_ptr<OpenScan>& scan);
    /// In the picture drawn last; while moving not in every one.
    static void countSeen(AllPictures& all, const std::shared_ptr<OpenScan>& scan, bool always);
    /// Finds the openness and the lines of sight of a scan whose pictures have been begun; until then gates choose what
    /// is drawn.
    void findSightLines(const std::shared_ptr<OpenScan>& scan);

    WorkerWith<AllPictures> worker_{this};
    Worker sight_worker_{this};  // ends before worker_, to which it speaks
};

}  // namespace vicon::viewer

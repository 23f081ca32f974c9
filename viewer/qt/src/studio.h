#pragma once

#include <chrono>
#include <list>
#include <memory>

#include "case_session.h"
#include "vicon/viewer/scene/film.h"
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

    /// The contexts end on the thread that they belong to; nothing is drawn after that.
    void end();

    /// An endoscopic picture: what is in it, and what is done about the wall that it shows.
    struct Wish {
        SnapshotRequest request;
        SnapshotResult place;
        bool still = true;
        bool count_seen = true;   ///< it is shown to somebody; while moving, some pictures are counted
        bool paint_seen = false;  ///< what was seen in earlier passes
        bool structure = false;   ///< cells coloured, gates drawn, what is drawn counted
        double lamp_reach_mm = kUsualLampReach_mm;
    };
    void drawEndoscopic(std::shared_ptr<OpenScan> scan, const Wish& wish);
    /// The same of the other scan; besideDrawn() follows.
    void drawBeside(std::shared_ptr<OpenScan> scan, const Wish& wish);
    void drawOverview(std::shared_ptr<OpenScan> scan, const SnapshotRequest& request, const SnapshotResult& place);
    /// A picture of a film, looking along the path from the wish's station; filmed() follows.
    /// @param last the film is finished with it
    void film(std::shared_ptr<OpenScan> scan, const Wish& wish, Heading heading, std::shared_ptr<Film> film, bool last);

    /// What a picture that is shown was made of: a click into it means that place, wherever the eye is by then.
    struct Shown {
        std::weak_ptr<OpenScan> scan;
        SnapshotResult place;
        Lens lens;

        bool isOf(const std::shared_ptr<OpenScan>& which) const { return which && scan.lock() == which; }
    };

signals:
    void filmed(const std::shared_ptr<vicon::viewer::Film>& film, bool finished);
    void endoscopicDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::Studio::Shown& shown);
    void besideDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::Studio::Shown& shown);
    void overviewDrawn(const vicon::viewer::Picture& picture, const vicon::viewer::PlaneView& view);
    void seenChanged();
    /// The pictures of a scan that has just been opened are made without it.
    void withoutOpenGl();
    void failed(const QString& message);

private:
    enum class Which { leading, beside };
    void draw(Which which, std::shared_ptr<OpenScan> scan, const Wish& wish);
    ReadingPictures& picturesOf(const std::shared_ptr<OpenScan>& scan);
    /// In the picture drawn last; while moving not in every one.
    void countSeen(const std::shared_ptr<OpenScan>& scan, bool always);

    struct Pictures {
        std::weak_ptr<OpenScan> of;
        std::unique_ptr<ReadingPictures> pictures;
        std::chrono::steady_clock::time_point counted;
    };
    std::list<Pictures> pictures_;  // the worker's
    /// Finds the lines of sight of a scan whose pictures have been begun; until then gates choose what is drawn.
    void findSightLines(const std::shared_ptr<OpenScan>& scan);

    Worker worker_{this};
    Worker sight_worker_{this};  // ends before worker_, to which it speaks
};

}  // namespace vicon::viewer

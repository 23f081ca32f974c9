#include "vicon/viewer/scene/reading_pictures.h"

#include <optional>

#include "pictures.h"
#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/seen_wall.h"

namespace vicon::viewer {

struct ReadingPictures::Parts {
    PreparedScan scan;
    CellVisibility visibility;
    SurfaceScene scene;
    Offscreen offscreen;
    OverviewGround ground;
    /// What the last endoscopic picture showed.
    struct Shown {
        SeenParts parts;
        Pose pose;
        Lens lens;
        bool told = false;  ///< seen_wall has looked at it
    };
    std::optional<Shown> shown;
    std::optional<SeenWall> seen_wall;  // made when it is first asked for

    SeenWall& seenWall()
    {
        if (!seen_wall)
            seen_wall.emplace(scan);
        if (!shown->told)
            seen_wall->look(shown->parts, shown->pose, shown->lens);
        shown->told = true;
        return *seen_wall;
    }

    explicit Parts(const PreparedScan& of) : scan(of), visibility(of), scene(of.cells()), offscreen(scene.renderer()) {}
};

ReadingPictures::ReadingPictures(const PreparedScan& scan) : parts_(std::make_unique<Parts>(scan)) {}
ReadingPictures::~ReadingPictures() = default;

Picture ReadingPictures::endoscopic(const SnapshotRequest& request, const SnapshotResult& place, bool still,
                                    const SeenSoFar* earlier)
{
    Parts& p = *parts_;
    const Lens lens{request.view_angle_deg, request.width, request.height};
    p.shown = Parts::Shown{p.visibility.seenFrom(place.pose, lens), place.pose, lens};
    p.scene.showSeen(p.shown->parts);
    p.scene.lookFrom(place.pose, request.view_angle_deg);
    Picture picture = p.offscreen.render(request.width, request.height, still ? 2 : 1);
    if (earlier)
        p.seenWall().tint(picture, earlier->earlier());
    finishEndoscopic(picture, p.scan, request, place);
    if (!request.peel.empty())
        p.shown.reset();
    return picture;
}

void ReadingPictures::countSeen(SeenSoFar& seen)
{
    if (parts_->shown)
        seen.see(parts_->seenWall().triangles());
}

ReadingPictures::Overview ReadingPictures::overview(const SnapshotRequest& request, const SnapshotResult& place)
{
    Parts& p = *parts_;
    if (p.ground.picture.width != request.width || p.ground.picture.height != request.height) {
        p.scene.showSeen({});
        p.ground = overviewGround(p.scan, request, p.scene, p.offscreen);
    }
    return {overviewOver(p.ground, p.scan, request, place), p.ground.view};
}

}  // namespace vicon::viewer

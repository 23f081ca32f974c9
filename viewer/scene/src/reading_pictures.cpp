#include "vicon/viewer/scene/reading_pictures.h"

#include "pictures.h"
#include "vicon/viewer/scene/cell_visibility.h"

namespace vicon::viewer {

struct ReadingPictures::Parts {
    PreparedScan scan;
    CellVisibility visibility;
    SurfaceScene scene;
    Offscreen offscreen;
    OverviewGround ground;

    explicit Parts(const PreparedScan& of) : scan(of), visibility(of), scene(of.cells()), offscreen(scene.renderer()) {}
};

ReadingPictures::ReadingPictures(const PreparedScan& scan) : parts_(std::make_unique<Parts>(scan)) {}
ReadingPictures::~ReadingPictures() = default;

Picture ReadingPictures::endoscopic(const SnapshotRequest& request, const SnapshotResult& place, bool still)
{
    Parts& p = *parts_;
    const Lens lens{request.view_angle_deg, request.width, request.height};
    p.scene.showSeen(p.visibility.seenFrom(place.pose, lens));
    p.scene.lookFrom(place.pose, request.view_angle_deg);
    Picture picture = p.offscreen.render(request.width, request.height, still ? 2 : 1);
    finishEndoscopic(picture, p.scan, request, place);
    return picture;
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

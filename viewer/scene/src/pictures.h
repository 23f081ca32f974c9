#pragma once

#include <memory>

#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/snapshot.h"
#include "vicon/viewer/scene/surface_scene.h"

namespace vicon::viewer {

/// The place a request asks for and the eye for it.
SnapshotResult placeOf(const PreparedScan& scan, const SnapshotRequest& request);

/// Who is shown: name, id and birth date, position and date. What is not known has no line.
std::vector<OverlayText> patientLines(const Caption& caption);
/// The lines that every caption has: who is shown, station, warnings.
std::vector<OverlayText> captionLines(const Caption& caption, double station_mm, double length_mm,
                                      const OrganWords& words);

/// What is written over an endoscopic picture; used by snapshots and flights alike.
Overlay endoscopicOverlay(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place);

/// The wall where the densities of tissue begin, for want of OpenGL; as fine as the request says that it is peeled.
void castWall(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request, const Pose& pose);
/// Endoscopic pictures of one scan; its surface is handed to the driver once.
class EndoscopicPictures {
public:
    explicit EndoscopicPictures(PreparedScan scan);
    Picture draw(const SnapshotRequest& request, const SnapshotResult& place);

private:
    PreparedScan scan_;
    SurfaceScene scene_;
    Offscreen offscreen_;
    bool occluded_ = false;  ///< the scene shades with ambient occlusion
};
/// Lays what the request asks to peel, and everything that is written, over a picture of the surface.
void finishEndoscopic(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request,
                      const SnapshotResult& place);
Picture slicesPicture(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place);
/// The overview's part that does not change while the eye moves.
struct OverviewGround {
    Picture picture;
    PlaneView view;
    TextSize caption;         ///< what the caption takes
    std::vector<Area> names;  ///< what the names of the colon's parts take
};
OverviewGround overviewGround(const PreparedScan& scan, const SnapshotRequest& request);
/// What is written over it.
Overlay overviewOverlay(const OverviewGround& ground, const PreparedScan& scan, const SnapshotRequest& request,
                        const SnapshotResult& place);
Picture overviewOver(const OverviewGround& ground, const PreparedScan& scan, const SnapshotRequest& request,
                     const SnapshotResult& place);
Picture overviewPicture(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place);

}  // namespace vicon::viewer

#pragma once

#include <memory>
#include <optional>

#include "scene_look.h"
#include "seen_surface.h"
#include "vicon/viewer/scene/band_picture.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/offscreen.h"
#include "vicon/viewer/scene/reading_pictures.h"
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

/// Which wall is shown, where there are two kinds, and what its tints mean.
std::vector<OverlayText> linesOfWall(const PreparedScan& scan, const WallLook& look, const SnapshotResult& place);

/// What is written over an endoscopic picture; used by snapshots and flights alike.
Overlay endoscopicOverlay(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place);

/// What is written over a slice.
/// @param cleansable there are densities without tagging, so the picture says which it shows
Overlay sliceOverlay(const SliceRequest& request, bool cleansable);

/// What is written over a band.
Overlay bandOverlay(const PreparedScan& scan, const BandMap& band, const BandPage& page, const BandRequest& request);

/// Rings around the markers that are in plain view from `pose`; the one that is looked at wherever it lies.
void addMarkersInView(Overlay& overlay, const PreparedScan& scan, const SnapshotRequest& request, const Pose& pose,
                      const Lens& lens, double text_px);

/// Endoscopic pictures of one scan; its surface is handed to the driver once.
class EndoscopicPictures {
public:
    explicit EndoscopicPictures(PreparedScan scan);
    /// Only for pictures from the places that `seen` was made for.
    EndoscopicPictures(PreparedScan scan, std::shared_ptr<const SeenSurface> seen);
    Picture draw(const SnapshotRequest& request, const SnapshotResult& place);
    /// The six faces around the eye.
    Picture drawCube(const SnapshotRequest& request, const SnapshotResult& place);

private:
    const Picture& wall(const SnapshotRequest& request, const SnapshotResult& place);
    void chooseCells(const Pose& pose, const Lens& lens);
    void wear(const WallLook& look);

    /// The wall as it was drawn last: what is laid over it changes more often.
    struct Drawn {
        Pose pose;
        Lens lens;
        WallLook look;
        Picture picture;
    };

    PreparedScan scan_;
    std::shared_ptr<const SeenSurface> seen_;  ///< nothing: all of the surface is drawn
    SurfaceScene scene_;
    Offscreen offscreen_;
    SceneLook look_;
    std::vector<float> tagging_;  ///< of what is seen
    std::optional<Drawn> last_;
};
/// Lays what the request asks to peel, and everything that is written, over a picture of the surface. Throws
/// Error{cancelled} where it is no longer wanted.
void finishEndoscopic(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request,
                      const SnapshotResult& place, const Progress* wanted = nullptr);
Picture slicesPicture(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place);
/// The two ends of a way, by name.
void addTips(Overlay& overlay, const Skeleton& skeleton, const OrganWords& words, const PlaneView& view,
             double text_px);
/// The overview's part that does not change while the eye moves.
struct OverviewGround {
    Picture picture;  ///< the wall, perhaps tinted, with what is written over it
    Picture wall;     ///< alone
    Overlay written;
    PlaneView view;
    TextSize caption;         ///< what the caption takes
    std::vector<Area> names;  ///< what the names of the colon's parts take
};
/// @param wanted throws Error{cancelled} where it is no longer
OverviewGround overviewGround(const PreparedScan& scan, const SnapshotRequest& request,
                              const Progress* wanted = nullptr);
/// What is written over it.
Overlay overviewOverlay(const OverviewGround& ground, const PreparedScan& scan, const SnapshotRequest& request,
                        const SnapshotResult& place);
Picture overviewOver(const OverviewGround& ground, const PreparedScan& scan, const SnapshotRequest& request,
                     const SnapshotResult& place);
Picture overviewPicture(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place);

}  // namespace vicon::viewer

#pragma once

#include <memory>

#include "vicon/core/progress.h"
#include "vicon/viewer/model/cube.h"
#include "vicon/viewer/model/orientation.h"
#include "vicon/viewer/model/review_rule.h"
#include "vicon/viewer/model/scan_coverage.h"
#include "vicon/viewer/model/thick_slice.h"
#include "vicon/viewer/model/window_level.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/cell_visibility.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// A slice as the reading room shows it; the plane passes through the middle of `view`.
struct SliceRequest {
    SlicePlane plane = SlicePlane::axial;
    PlaneView view;
    double pixel_ratio = 1;  ///< of the screen, as in SnapshotRequest
    double text_px = 0;      ///< likewise
    Point3 point_mm;         ///< where the crosshair is
    Pose pose;               ///< the endoscopic view's eye, drawn with its direction
    WindowLevel window;
    std::vector<Marker> markers;     ///< drawn where they lie within 5 mm of the plane
    std::vector<PriorPlace> priors;  ///< likewise
    Caption caption;
    bool cleansed = false;  ///< without tagging, where that was taken out
    ThickSlice thick;
    int voxels_a_pixel = 0;  ///< above 0: the view is pixelForPixel() of so many, and the picture says so
    bool tracks = false;     ///< the rim of the lumen around the eye is drawn
};
/// Needs no display. The picture says which densities it shows, where there are two kinds.
/// @param cleansed PreparedScan::cleansed()
/// @param inside PreparedScan::inside(), for a request that tracks
/// @param wanted throws Error{cancelled} where it is no longer
Picture slicePicture(const HuView& volume, const SliceRequest& request, const HuView* cleansed = nullptr,
                     const InsideView* inside = nullptr, const Progress* wanted = nullptr);

/// What an endoscopic picture shows beside the wall.
struct EndoscopicLook {
    const ScanCoverage* earlier = nullptr;  ///< the wall that was seen in earlier passes is tinted; nothing: none is
    bool structure = false;                 ///< cells in colours of their own, the gates, and how much is drawn
    double lamp_factor = 1;                 ///< of the lamp's usual reach there, see lampReachAt_mm()
    const std::vector<std::uint8_t>* missed = nullptr;  ///< of each triangle, 1 where it is tinted as missed
    bool on_screen = true;             ///< false: a picture for a list, which countSeen() knows nothing of
    const Progress* wanted = nullptr;  ///< whether rays are still to be cast; nothing: they are
};

/// The pictures of a scan that move with the eye, one after the other from the same scene. To be made, used and
/// destroyed on one thread.
class ReadingPictures {
public:
    /// Chooses what to draw by gates alone, which are there at once. Throws as PreparedScan does.
    explicit ReadingPictures(const PreparedScan& scan);
    ~ReadingPictures();

    /// Without OpenGL the endoscopic view is cast through the densities, and what it shows does not count as seen.
    bool hasOpenGl() const;

    /// The endoscopic view from `place`, only cells that may be seen drawn; the request's width and height must be set.
    /// Ambient occlusion is in it as soon as the scan has its openness, which is not waited for.
    /// Throws Error{cancelled} where it is no longer wanted.
    /// @param still smoothed; while the eye moves not, and peeled as coarsely as ten pictures a second ask for
    Picture endoscopic(const SnapshotRequest& request, const SnapshotResult& place, bool still,
                       const EndoscopicLook& look = {});
    /// The same of a face of the cube around the eye, with nothing written over it.
    /// @param seen counts what it shows; nothing: it is not counted
    Picture cubeFace(const SnapshotRequest& of_cube, const SnapshotResult& place, CubeFace face, bool still,
                     const EndoscopicLook& look, ScanCoverage* seen);
    /// From now on `visibility`, of the same scan, chooses what is drawn; the pictures stay the same, but take less
    /// time.
    void chooseBy(std::shared_ptr<const CellVisibility> visibility);
    /// Tells what the last endoscopic picture on the screen shows well. Not where it was peeled: the wall is not in it.
    /// @param now_s see ScanCoverage::show()
    void countSeen(ScanCoverage& seen, double now_s);

    /// The whole colon from the front, and which millimetres its pixels are.
    struct Overview {
        Picture picture;
        PlaneView view;
    };
    /// @param reviewed is painted; nothing: none is
    /// @param still it is painted as it is now; else at most twice a second anew
    /// @param wanted throws Error{cancelled} where it is no longer
    Overview overview(const SnapshotRequest& request, const SnapshotResult& place,
                      const ScanCoverage* reviewed = nullptr, bool still = true, const Progress* wanted = nullptr);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace vicon::viewer

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/viewer/model/triangle_raster.h"
#include "vicon/viewer/model/turned_view.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/prepared_scan.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// A picture of a whole organ from outside.
struct TurnedRequest {
    int width = 0, height = 0;
    double pixel_ratio = 1;  ///< of the screen, as in SnapshotRequest
    double text_px = 0;      ///< likewise
    TurnedView view;
    SnapshotResult eye;
    std::vector<Marker> markers;     ///< of the scan
    std::vector<PriorPlace> priors;  ///< likewise
    Caption caption;
    std::vector<std::uint8_t> seen;  ///< of each triangle, 1: painted as seen; empty: none is
    bool still = true;               ///< smoothed
};

struct TurnedPicture {
    Picture picture;
    PlaneView view;  ///< of the picture
    std::shared_ptr<const TriangleRaster> raster;
    int finer = 1;  ///< the raster than the picture

    /// The point of the wall that a pixel shows.
    std::optional<Point3> pointAt(const CellSurface& surface, Pixel at) const;
    /// Whether other wall lies before a point, by more than `within_mm`.
    bool hides(const CellSurface& surface, Point3 point, double within_mm) const;
};

/// The wall seen from outside, opaque, nearer parts brighter; what of it was seen from inside painted, markers on it,
/// those behind other wall as rings. Needs no display. Throws Error{cancelled}, and as PreparedScan does.
TurnedPicture turnedPicture(const PreparedScan& scan, const TurnedRequest& request, Progress& progress);

}  // namespace vicon::viewer

#pragma once

#include <string>

#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/prepared_scan.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// The circle that is peeled, for a radiologist's eye on one finding.
PictureCircle peeledCircle(const SnapshotRequest& request);

/// Lays what the request asks to peel over a picture of the surface. Where the wall is shown as acquired, rays begin at
/// the eye, so that fluid is seen. Throws Error{cancelled} where it is no longer wanted.
void layPeelingOver(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request,
                    const SnapshotResult& place, const Progress* wanted = nullptr);

/// The wall by rays through the acquired densities, as fine as the request says that it is peeled: as acquired, from
/// the eye to where they leave gas; else, for want of OpenGL, from the lumen's wall to where those of tissue begin.
/// Throws Error{cancelled} where it is no longer wanted.
void castWall(Picture& picture, const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place,
              const Progress* wanted = nullptr);

}  // namespace vicon::viewer

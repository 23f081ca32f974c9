#pragma once

#include "vicon/viewer/model/cube.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/prepared_scan.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// Of a picture of the unfolded cube, what one of its faces asks for: square, 90 degrees, nothing peeled or written.
SnapshotRequest faceRequest(const SnapshotRequest& of_cube, const CubeLayout& layout);
/// The place turned to a face.
SnapshotResult faceOf(CubeFace face, SnapshotResult place);
/// Puts a face where it belongs.
void placeFace(Picture& cube, const CubeLayout& layout, CubeFace face, const Picture& picture);
/// What is written over a cube: the faces' names, with the side of the patient that each looks to; markers in view; the
/// caption in the free corner, where the request wants one.
Overlay cubeOverlay(const PreparedScan& scan, const SnapshotRequest& request, const SnapshotResult& place);

}  // namespace vicon::viewer

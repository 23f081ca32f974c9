#pragma once

#include <optional>

#include "vicon/cases/marker.h"
#include "vicon/viewer/model/plane_size.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/prepared_scan.h"
#include "vicon/viewer/scene/snapshot.h"

namespace vicon::viewer {

/// How many voxels of a density sample have which density, with the mean and its spread; air, fat, soft tissue and
/// tagging are named where the axis shows them. Needs no display.
Picture histogramPicture(const DensitySample& sample, int width, int height, double pixel_ratio = 1);

/// The slice in which a finding is measured, with the diameter drawn in. Needs no display. Throws as PreparedScan does,
/// and Error{cancelled} where `wanted` is no longer.
Picture planePicture(const PreparedScan& scan, const PlaneSize& size, const Caption& caption, int width, int height,
                     double pixel_ratio = 1, const Progress* wanted = nullptr);

/// What was measured of a marker: its best plane and its histogram beside each other, each square with this side; one
/// of them where the other was not taken, nothing where neither was. Throws as planePicture() does.
std::optional<Picture> measuresPicture(const PreparedScan& scan, const Marker& marker, const Caption& caption, int side,
                                       double pixel_ratio = 1, const Progress* wanted = nullptr);

}  // namespace vicon::viewer

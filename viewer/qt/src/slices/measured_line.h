#pragma once

#include <QString>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vicon/core/volume.h"
#include "vicon/viewer/model/band_page.h"
#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/model/cube.h"
#include "vicon/viewer/model/peeling.h"
#include "widgets/calliper.h"

namespace vicon::viewer {

/// What is measured, in one scan: from its first to its last point; one point while the other end is missing.
struct MeasuredLine {
    std::string scan_id;  ///< views of other scans do not show it
    std::vector<Point3> way_mm;
    QString text;
    std::vector<Point3> rim_mm;  ///< of an outlined polyp, around it
};

/// Where a density was taken.
struct SampledBall {
    Point3 centre_mm;
    double radius_mm = 0;
};

/// The circle in which a slice cuts the ball; nothing where it does not.
std::optional<PictureCircle> inSlice(const SampledBall& ball, const PlaneView& view);

/// The line where a slice passes within 5 mm of one of its ends or between them. An end is drawn as such, and can be
/// dragged, where it lies within half a voxel of the slice; a line that leaves the slice is dashed, from end to end.
std::optional<Calliper> inSlice(const MeasuredLine& line, const PlaneView& view, const Grid& grid);

/// The line as the eye sees it. Nothing where an end lies behind it.
std::optional<Calliper> inEndoscopy(const MeasuredLine& line, const Pose& pose, const Lens& lens);

/// The line on the faces of an unfolded cube around the eye, cut where it goes from one face to another.
std::optional<Calliper> inCube(const MeasuredLine& line, const Pose& pose, const CubeLayout& layout);

/// The line in a parallel projection of the whole organ, straight from end to end: dashed and said to be foreshortened
/// where it leaves the picture's plane. An end behind other wall has no grip.
/// @param isHidden whether other wall lies before a point; of what is translucent none does
std::optional<Calliper> inProjection(
    const MeasuredLine& line, const PlaneView& view,
    const std::function<bool(Point3)>& isHidden = [](Point3) { return false; });

/// The line on a band, straight between the places of its ends: dashed, as the band is stretched. Nothing where neither
/// end is shown.
/// @param ends their places, one while the other is missing
std::optional<Calliper> inBand(const MeasuredLine& line, const std::vector<BandPlace>& ends, const BandMap& band,
                               const BandPage& page);

}  // namespace vicon::viewer

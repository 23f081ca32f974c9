#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// A finding's size in a plane through the two points that a reader clicked on its edges.
struct PlaneSize {
    double diameter_mm = 0;  ///< the largest of its cross-section
    Point3 from_mm, to_mm;   ///< the ends of that diameter
    double area_mm2 = 0;     ///< of the cross-section above the line between the clicked points
    Point3 middle_mm;        ///< of that line
    Vector3 along, up;       ///< unit vectors in the plane: along the line; into the lumen
};

/// Turns a plane about the line through two points of the wall, up to 60 degrees from upright on it, and takes the
/// plane in which what stands above the line has the largest cross-section; the diameter is the greatest distance
/// between two points of that cross-section, the clicked ones included. What hangs over beyond the points belongs to
/// it, the wall that curves up there does not. Nothing where nothing stands above the line in any plane, it is nowhere
/// bounded by lumen, or the points are less than 1 or more than 80 mm asunder.
/// @param eye a place in the lumen from which the points are seen
std::optional<PlaneSize> sizeOnBestPlane(const InsideView& inside, Point3 a, Point3 b, Point3 eye);

/// The plane as a picture with the lumen above; what is `field_mm` wide around the line's middle.
PlaneView viewOf(const PlaneSize& size, int width, int height, double field_mm);

/// As it is kept with a marker, under "size", "plane": {"diameter_mm", "from_mm", "to_mm", "area_mm2", "middle_mm",
/// "along", "up"}.
nlohmann::json toJson(const PlaneSize& size);
/// Nothing where the JSON is not such a size.
std::optional<PlaneSize> planeSizeFromJson(const nlohmann::json& json);

}  // namespace vicon::viewer

#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vicon/core/enum_names.h"
#include "vicon/core/geometry.h"

namespace vicon {

/// How the lumen is divided.
enum class SubdivideMethod { flood, thesis };
inline constexpr EnumNames<SubdivideMethod, 2> kSubdivideMethodNames{{
    {SubdivideMethod::flood, "flood"},
    {SubdivideMethod::thesis, "thesis"},
}};
constexpr const auto& optionNames(SubdivideMethod /*value*/)
{
    return kSubdivideMethodNames;
}
/// As files and records have it: the method's name; of nothing "none".
std::string nameOf(const std::optional<SubdivideMethod>& method);
/// Throws Error{bad_input} for any other name.
std::optional<SubdivideMethod> subdivideMethodFrom(const std::string& name);

/// The passage between two segments that touch. Its gate is the rectangle with these corners, in order around it; it
/// encloses the portal and is already dilated by a voxel diagonal, so that what lies behind the portal is seen through
/// it.
struct Portal {
    int segment_a = 0;  ///< the smaller number
    int segment_b = 0;
    Point3 centre_mm;
    Vector3 normal;  ///< unit vector from a to b
    double area_mm2 = 0;
    std::array<Point3, 4> gate_mm;
    /// The gate moved along the normal to both sides until everything that the two segments share lies between, also
    /// where a flooded portal is not flat: corners 0-3 on the side of a, 4-7 on the side of b, in the gate's order. The
    /// screen rectangle of these eight points contains whatever is seen through the portal, from any eye.
    std::array<Point3, 8> box_mm;
    bool along_skeleton = true;  ///< false: two segments touch without being neighbours along the skeleton
};

/// A segment and the part of the skeleton that runs through it.
struct SegmentInfo {
    int number = 0;  ///< 1..N from the rectum
    double from_station_mm = 0;
    double to_station_mm = 0;
    double volume_mm3 = 0;
    std::size_t inside_voxels = 0;
    std::size_t surface_voxels = 0;
    std::size_t triangles = 0;
    Point3 lower_mm;  ///< bounding box, LPS
    Point3 upper_mm;
};

struct Subdivision {
    std::optional<SubdivideMethod> method;  ///< nothing: a cavity without a path, which is not divided
    nlohmann::json parameters = nlohmann::json::object();
    std::vector<SegmentInfo> segments;  ///< in order of number
    std::vector<Portal> portals;
    nlohmann::json statistics =
        nlohmann::json::object();  ///< specified segments, triangles a cell: the thesis' Table 2
};

}  // namespace vicon

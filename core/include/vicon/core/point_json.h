#pragma once

#include <nlohmann/json.hpp>

#include "vicon/core/geometry.h"

namespace vicon {

/// A point as JSON is [x, y, z], in LPS mm; what is none throws nlohmann's exception. An option whose field is a
/// std::vector<Point3> is one of points: [[x, y, z], ...] in a file, or the text "x,y,z;x,y,z" there and on the command
/// line.
inline void to_json(nlohmann::json& json, const Point3& point)
{
    json = {point.x, point.y, point.z};
}
inline void from_json(const nlohmann::json& json, Point3& point)
{
    point = {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace vicon

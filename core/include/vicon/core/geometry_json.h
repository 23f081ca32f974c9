#pragma once

#include <nlohmann/json.hpp>

#include "vicon/core/geometry.h"

namespace vicon {

/// Points and directions as JSON: [x, y, z], LPS mm. Reading throws nlohmann::json::exception where there is no list of
/// three numbers; who reads a file says which one it was. An option whose field is a std::vector<Point3> is one of
/// points: [[x, y, z], ...] in a file, or the text "x,y,z;x,y,z" there and on the command line.
void to_json(nlohmann::json& json, const Point3& point);
void from_json(const nlohmann::json& json, Point3& point);
void to_json(nlohmann::json& json, const Vector3& vector);
void from_json(const nlohmann::json& json, Vector3& vector);

}  // namespace vicon

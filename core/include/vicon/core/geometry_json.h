#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon {

/// [x, y, z], LPS mm.
nlohmann::json pointToJson(Point3 p);
nlohmann::json vectorToJson(Vector3 v);
nlohmann::json pointsToJson(const std::vector<Point3>& points);

/// Throw nlohmann::json::exception where it is no list of three numbers; who reads a file says which one it was.
Point3 pointFromJson(const nlohmann::json& json);
Vector3 vectorFromJson(const nlohmann::json& json);
std::vector<Point3> pointsFromJson(const nlohmann::json& json);

}  // namespace vicon

#pragma once

#include <nlohmann/json.hpp>

#include "vicon/core/geometry.h"

namespace vicon {

/// A point as JSON is [x, y, z], in LPS mm. Throws nlohmann's exception for anything else.
inline void to_json(nlohmann::json& json, const Point3& point)
{
    json = {point.x, point.y, point.z};
}
inline void from_json(const nlohmann::json& json, Point3& point)
{
    point = {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

}  // namespace vicon

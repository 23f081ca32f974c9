#include "vicon/core/geometry_json.h"

#include <array>
#include <vector>

namespace vicon {
namespace {

constexpr std::size_t kAxes = 3;

template <class Triple>
Triple tripleFrom(const nlohmann::json& json)
{
    const auto numbers = json.get<std::array<double, kAxes>>();  // throws for whatever is no list, or too short
    if (json.size() > kAxes)
        (void)json.at("a fourth number");  // throws: a list has no such key
    return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

nlohmann::json pointToJson(Point3 p)
{
    return {p.x, p.y, p.z};
}

nlohmann::json vectorToJson(Vector3 v)
{
    return {v.x, v.y, v.z};
}

nlohmann::json pointsToJson(const std::vector<Point3>& points)
{
    nlohmann::json list = nlohmann::json::array();
    for (const Point3 p : points)
        list.push_back(pointToJson(p));
    return list;
}

Point3 pointFromJson(const nlohmann::json& json)
{
    return tripleFrom<Point3>(json);
}

Vector3 vectorFromJson(const nlohmann::json& json)
{
    return tripleFrom<Vector3>(json);
}

std::vector<Point3> pointsFromJson(const nlohmann::json& json)
{
    std::vector<Point3> points;
    for (const nlohmann::json& p : json)
        points.push_back(pointFromJson(p));
    return points;
}

}  // namespace vicon

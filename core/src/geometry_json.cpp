#include "vicon/core/geometry_json.h"

#include <array>

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

void to_json(nlohmann::json& json, const Point3& point)
{
    json = {point.x, point.y, point.z};
}

void from_json(const nlohmann::json& json, Point3& point)
{
    point = tripleFrom<Point3>(json);
}

void to_json(nlohmann::json& json, const Vector3& vector)
{
    json = {vector.x, vector.y, vector.z};
}

void from_json(const nlohmann::json& json, Vector3& vector)
{
    vector = tripleFrom<Vector3>(json);
}

}  // namespace vicon

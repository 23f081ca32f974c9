#include "surface_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "vicon/core/error.h"

namespace vicon {
namespace {

Vector3 normalOf(const CellSurface& surface, std::size_t n)
{
    return {surface.normals[3 * n], surface.normals[3 * n + 1], surface.normals[3 * n + 2]};
}

}  // namespace

Vector3 anyAcross(Vector3 axis)
{
    const Vector3 other = std::abs(axis.x) < 0.7 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    return normalized(cross(axis, other));
}

SurfacePatch::SurfacePatch(const CellSurface& surface, Point3 at, double radius_mm, double catch_mm)
{
    std::unordered_map<std::uint32_t, std::uint32_t> own;  // numbers of the surface's points here
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t nearest_triangle = 0;
    for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
        const std::uint32_t* corners = &surface.triangles[3 * t];
        if (distance(surface.point(corners[0]), at) > radius_mm)
            continue;
        Triangle triangle{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto [found, is_new] = own.emplace(corners[c], std::uint32_t(points_.size()));
            if (is_new) {
                points_.push_back(surface.point(corners[c]));
                normals_.push_back(normalOf(surface, corners[c]));
            }
            triangle[c] = found->second;
            if (const double d = distance(points_[found->second], at); d < nearest) {
                nearest = d;
                nearest_mm_ = points_[found->second];
                nearest_triangle = triangles_.size();
            }
        }
        triangles_.push_back(triangle);
    }
    if (nearest > catch_mm)
        throw Error(ErrorCode::bad_input, "there is no wall", "at the point", "point at the polyp's surface");
    joinTriangles();
    keepWhatHangsTogether(nearest_triangle);
}

void SurfacePatch::joinTriangles()
{
    beside_.assign(triangles_.size(), {kNone, kNone, kNone});
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>> open;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t a = triangles_[t][c], b = triangles_[t][(c + 1) % 3];
            const auto key = std::minmax(a, b);
            if (const auto other = open.find(key); other != open.end()) {
                beside_[t][c] = other->second.first;
                beside_[other->second.first][other->second.second] = t;
                open.erase(other);
            } else {
                open.emplace(key, std::pair(t, c));
            }
        }
}

void SurfacePatch::keepWhatHangsTogether(std::size_t with)
{
    std::vector<bool> kept(triangles_.size(), false);
    std::vector<std::uint32_t> todo{std::uint32_t(with)};
    kept[with] = true;
    while (!todo.empty()) {
        const std::uint32_t t = todo.back();
        todo.pop_back();
        for (const std::uint32_t other : beside_[t])
            if (other != kNone && !kept[other]) {
                kept[other] = true;
                todo.push_back(other);
            }
    }
    std::vector<Triangle> mine;
    std::vector<bool> used(points_.size(), false);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (kept[t]) {
            mine.push_back(triangles_[t]);
            for (const std::uint32_t p : triangles_[t])
                used[p] = true;
        }
    triangles_ = std::move(mine);
    for (std::size_t p = 0; p < points_.size(); ++p)
        if (!used[p])
            normals_[p] = {0, 0, 0};  // of another part of the wall
    joinTriangles();
}

Vector3 SurfacePatch::normalNear(Point3 at, double radius_mm) const
{
    Vector3 sum;
    for (std::size_t p = 0; p < points_.size(); ++p)
        if (distance(points_[p], at) <= radius_mm)
            sum += normals_[p];
    return normalized(sum);
}

Point3 SurfacePatch::highest(Point3 on_line, Vector3 up, double radius_mm) const
{
    double most = -std::numeric_limits<double>::infinity();
    Point3 top = on_line;
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const Vector3 from = points_[p] - on_line;
        const double height = dot(from, up);
        if (length(from - up * height) <= radius_mm && height > most && dot(normals_[p], up) > 0) {
            most = height;
            top = points_[p];
        }
    }
    return top;
}

bool SurfacePatch::holds(Point3 of_surface) const
{
    for (const Triangle& triangle : triangles_)
        for (const std::uint32_t p : triangle)
            if (points_[p] == of_surface)
                return true;
    return false;
}

std::optional<std::size_t> SurfacePatch::onAxis(Point3 near, Vector3 axis) const
{
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> found;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const Point3 a = points_[triangles_[t][0]], b = points_[triangles_[t][1]], c = points_[triangles_[t][2]];
        const Vector3 across = cross(b - a, c - a);
        const double facing = dot(across, axis);
        if (std::abs(facing) < 1e-12)
            continue;
        const double along = dot(a - near, across) / facing;
        const Point3 hit = near + axis * along;
        const auto inside = [&](Point3 from, Point3 to) { return dot(cross(to - from, hit - from), across) >= -1e-9; };
        if (inside(a, b) && inside(b, c) && inside(c, a) && std::abs(along) < nearest) {
            nearest = std::abs(along);
            found = t;
        }
    }
    return found;
}

std::vector<Point3> SurfacePatch::section(std::size_t from_triangle, Vector3 axis, Vector3 out, double length_mm) const
{
    // Inside the triangle, where the half plane leaves it by one edge.
    const auto [a, b, c] = triangles_[from_triangle];
    const Point3 origin = points_[a] + (points_[b] - points_[a] + (points_[c] - points_[a])) / 3;
    const Vector3 aside = cross(axis, out);
    const auto off = [&](std::uint32_t p) { return dot(points_[p] - origin, aside); };
    std::vector<Point3> line;
    std::uint32_t t = std::uint32_t(from_triangle), came_from = kNone;
    double gone_mm = 0;
    while (t != kNone && gone_mm < length_mm) {
        std::optional<std::size_t> way;
        Point3 place;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = triangles_[t][c], b = triangles_[t][(c + 1) % 3];
            const double from = off(a), to = off(b);
            if ((from < 0) == (to < 0) || (beside_[t][c] != kNone && beside_[t][c] == came_from))
                continue;
            const Point3 crossing = interpolate(points_[a], points_[b], from / (from - to));
            if (came_from == kNone && dot(crossing - origin, out) <= (way ? dot(place - origin, out) : -1e300))
                continue;
            way = c;
            place = crossing;
        }
        if (!way)
            break;
        gone_mm += line.empty() ? 0 : distance(line.back(), place);
        line.push_back(place);
        came_from = t;
        t = beside_[t][*way];
    }
    return line;
}

}  // namespace vicon

#include "surface_around.h"

#include <algorithm>
#include <array>
#include <limits>

namespace vicon {
namespace {

constexpr std::size_t kDirections = 26;  // to the faces, edges and corners of a cube

std::array<Vector3, kDirections> directions()
{
    std::array<Vector3, kDirections> all;
    std::size_t count = 0;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0)
                    all[count++] = normalized({double(x), double(y), double(z)});
    return all;
}

struct Found {
    double distance_mm = std::numeric_limits<double>::infinity();
    Point3 place;
};

}  // namespace

std::vector<Point3> surfaceAround(const CellSurface& surface, Point3 at, double within_mm, double catch_mm)
{
    const auto all = directions();
    std::array<Found, kDirections> nearest;
    for (std::size_t n = 0; n < surface.pointCount(); ++n) {
        const Point3 p = surface.point(n);
        const Vector3 off = p - at,
                      normal{surface.normals[3 * n], surface.normals[3 * n + 1], surface.normals[3 * n + 2]};
        const double away_mm = length(off);
        if (away_mm > within_mm || (away_mm > catch_mm && dot(off, normal) <= 0))
            continue;
        std::size_t towards = 0;
        for (std::size_t d = 1; d < kDirections; ++d)
            if (dot(off, all[d]) > dot(off, all[towards]))
                towards = d;
        if (away_mm < nearest[towards].distance_mm)
            nearest[towards] = {away_mm, p};
    }
    std::sort(nearest.begin(), nearest.end(),
              [](const Found& a, const Found& b) { return a.distance_mm < b.distance_mm; });
    std::vector<Point3> places;
    for (const Found& found : nearest)
        if (found.distance_mm <= within_mm)
            places.push_back(found.place);
    return places;
}

}  // namespace vicon

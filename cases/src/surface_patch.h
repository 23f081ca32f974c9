#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vicon/core/cell_surface.h"

namespace vicon {

/// A unit vector across a unit vector; always the same one.
Vector3 anyAcross(Vector3 axis);

/// The part of a surface around a point that hangs together with what is nearest to it, and sections through it.
class SurfacePatch {
public:
    /// Throws Error{bad_input} when the surface is not within `catch_mm` of the point.
    SurfacePatch(const CellSurface& surface, Point3 at, double radius_mm, double catch_mm);

    /// The surface's point nearest to what was asked for.
    Point3 nearest_mm() const { return nearest_mm_; }
    /// Whether a point of the surface is one of these.
    bool holds(Point3 of_surface) const;
    /// The mean normal of the points within a distance, a unit vector.
    Vector3 normalNear(Point3 at, double radius_mm) const;
    /// The highest point along a direction within a distance of a line.
    Point3 highest(Point3 on_line, Vector3 up, double radius_mm) const;
    /// The triangle that an axis meets nearest to a point; nothing where it meets none.
    std::optional<std::size_t> onAxis(Point3 near, Vector3 axis) const;
    /// The section with the half plane that leaves the axis in a direction, from the triangle that the axis meets.
    std::vector<Point3> section(std::size_t from_triangle, Vector3 axis, Vector3 out, double length_mm) const;

private:
    static constexpr std::uint32_t kNone = ~std::uint32_t(0);
    using Triangle = std::array<std::uint32_t, 3>;

    void joinTriangles();
    void keepWhatHangsTogether(std::size_t with);

    std::vector<Point3> points_;
    std::vector<Vector3> normals_;
    std::vector<Triangle> triangles_;
    std::vector<Triangle> beside_;  ///< of each triangle: beyond the edge from corner n to n + 1
    Point3 nearest_mm_;
};

}  // namespace vicon

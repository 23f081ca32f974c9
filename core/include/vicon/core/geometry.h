#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace vicon {

/// A displacement or direction in DICOM patient coordinates (LPS), millimetres.
struct Vector3 {
    double x = 0, y = 0, z = 0;

    friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
    friend Vector3 operator*(Vector3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Vector3 operator*(double s, Vector3 a) { return a * s; }
    friend Vector3 operator/(Vector3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
    friend bool operator==(Vector3, Vector3) = default;
    Vector3& operator+=(Vector3 b) { return *this = *this + b; }
    Vector3& operator-=(Vector3 b) { return *this = *this - b; }
};

/// A position in DICOM patient coordinates (LPS), millimetres. Points subtract to vectors and do not add.
struct Point3 {
    double x = 0, y = 0, z = 0;

    friend Point3 operator+(Point3 p, Vector3 v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
    friend Point3 operator-(Point3 p, Vector3 v) { return {p.x - v.x, p.y - v.y, p.z - v.z}; }
    friend Vector3 operator-(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend bool operator==(Point3, Point3) = default;
    Point3& operator+=(Vector3 v) { return *this = *this + v; }
};

inline double dot(Vector3 a, Vector3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector3 cross(Vector3 a, Vector3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vector3 a)
{
    return std::sqrt(dot(a, a));
}
inline double distance(Point3 a, Point3 b)
{
    return length(a - b);
}
/// The unit vector along `a`; `a` itself when it has no length.
inline Vector3 normalized(Vector3 a)
{
    const double l = length(a);
    return l > 0 ? a / l : a;
}
inline Point3 interpolate(Point3 a, Point3 b, double t)
{
    return a + (b - a) * t;
}

/// Index of a voxel; never leaves the stage that computed it.
struct Index3 {
    int i = 0, j = 0, k = 0;
    friend bool operator==(Index3, Index3) = default;
};

/// A voxel position between voxels, in units of voxels.
struct ContinuousIndex3 {
    double i = 0, j = 0, k = 0;
};

/// Where the voxels of a volume lie: voxel (i,j,k) is centred at
/// origin_mm + axis[0]*spacing_mm[0]*i + axis[1]*spacing_mm[1]*j + axis[2]*spacing_mm[2]*k, in LPS mm.
/// The axes are orthonormal; they may be left-handed.
struct Grid {
    std::array<int, 3> size{0, 0, 0};
    Point3 origin_mm;
    std::array<double, 3> spacing_mm{1, 1, 1};
    std::array<Vector3, 3> axis{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};

    std::size_t voxelCount() const { return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]); }
    /// Offset of a voxel in memory, i fastest. The index must lie inside.
    std::size_t offset(Index3 v) const
    {
        return std::size_t(v.i) + std::size_t(size[0]) * (std::size_t(v.j) + std::size_t(size[1]) * std::size_t(v.k));
    }
    Index3 indexOf(std::size_t offset) const
    {
        const auto nx = std::size_t(size[0]), ny = std::size_t(size[1]);
        return {int(offset % nx), int(offset / nx % ny), int(offset / (nx * ny))};
    }
    bool contains(Index3 v) const
    {
        return v.i >= 0 && v.j >= 0 && v.k >= 0 && v.i < size[0] && v.j < size[1] && v.k < size[2];
    }
    Point3 pointAt(ContinuousIndex3 c) const
    {
        return origin_mm + axis[0] * (spacing_mm[0] * c.i) + axis[1] * (spacing_mm[1] * c.j) +
               axis[2] * (spacing_mm[2] * c.k);
    }
    Point3 pointAt(Index3 v) const { return pointAt(ContinuousIndex3{double(v.i), double(v.j), double(v.k)}); }
    ContinuousIndex3 continuousIndexAt(Point3 p) const
    {
        const Vector3 d = p - origin_mm;
        return {dot(d, axis[0]) / spacing_mm[0], dot(d, axis[1]) / spacing_mm[1], dot(d, axis[2]) / spacing_mm[2]};
    }
    /// The voxel that holds `p`; it may lie outside the grid: ask contains().
    Index3 indexAt(Point3 p) const
    {
        const ContinuousIndex3 c = continuousIndexAt(p);
        return {int(std::floor(c.i + 0.5)), int(std::floor(c.j + 0.5)), int(std::floor(c.k + 0.5))};
    }
    double voxelVolume_mm3() const { return spacing_mm[0] * spacing_mm[1] * spacing_mm[2]; }
    friend bool operator==(const Grid&, const Grid&) = default;
};

}  // namespace vicon

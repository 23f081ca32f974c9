#pragma once

#include <cstdint>
#include <vector>

namespace vicon::viewer {

/// What part of a surface has been seen, triangle by triangle.
class Coverage {
public:
    /// @param areas_mm2 of the triangles, in order
    explicit Coverage(std::vector<float> areas_mm2);

    /// Marks triangles as seen; numbers beyond the surface are ignored.
    void see(const std::vector<std::uint32_t>& triangles);
    void forget();

    std::size_t triangleCount() const { return seen_.size(); }
    bool seen(std::size_t triangle) const { return seen_[triangle] != 0; }
    /// 1 for each that is, 0 for others.
    const std::vector<std::uint8_t>& seenTriangles() const { return seen_; }
    double area_mm2(std::size_t triangle) const { return areas_mm2_[triangle]; }
    std::size_t seenCount() const { return seen_count_; }
    double seenArea_mm2() const { return seen_area_; }
    double wholeArea_mm2() const { return whole_area_; }
    /// Seen area over whole area, 0 to 1; 1 for a surface without area.
    double fraction() const { return whole_area_ > 0 ? seen_area_ / whole_area_ : 1; }

private:
    std::vector<float> areas_mm2_;
    std::vector<std::uint8_t> seen_;
    std::size_t seen_count_ = 0;
    double seen_area_ = 0, whole_area_ = 0;
};

/// Areas of the triangles of an indexed surface: three coordinates a point, three point numbers a triangle.
std::vector<float> triangleAreas_mm2(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles);

}  // namespace vicon::viewer

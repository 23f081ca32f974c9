#include "vicon/viewer/model/coverage.h"

#include <algorithm>

#include "vicon/core/geometry.h"

namespace vicon::viewer {

Coverage::Coverage(std::vector<float> areas_mm2) : areas_mm2_(std::move(areas_mm2)), seen_(areas_mm2_.size(), 0)
{
    for (const float area : areas_mm2_)
        whole_area_ += area;
}

void Coverage::see(const std::vector<std::uint32_t>& triangles)
{
    for (const std::uint32_t n : triangles)
        if (n < seen_.size() && !seen_[n]) {
            seen_[n] = 1;
            ++seen_count_;
            seen_area_ += areas_mm2_[n];
        }
}

void Coverage::forget()
{
    std::fill(seen_.begin(), seen_.end(), std::uint8_t(0));
    seen_count_ = 0;
    seen_area_ = 0;
}

std::vector<float> triangleAreas_mm2(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles)
{
    const auto point = [&](std::uint32_t n) {
        const std::size_t at = 3 * std::size_t(n);
        return Point3{points_mm[at], points_mm[at + 1], points_mm[at + 2]};
    };
    std::vector<float> areas(triangles.size() / 3);
    for (std::size_t n = 0; n < areas.size(); ++n) {
        const Point3 a = point(triangles[3 * n]);
        areas[n] = float(length(cross(point(triangles[3 * n + 1]) - a, point(triangles[3 * n + 2]) - a)) / 2);
    }
    return areas;
}

}  // namespace vicon::viewer

#include "vicon/viewer/model/review_rule.h"

#include <cmath>

namespace vicon::viewer {

std::vector<std::uint32_t> wellShown(const std::vector<float>& points_mm, const std::vector<std::uint32_t>& triangles,
                                     const std::vector<std::uint32_t>& shown, const Pose& pose, const Lens& lens,
                                     double pixel_ratio)
{
    const double least_cosine = std::cos(radians(kMostIncidence_deg));
    const double farthest_mm = lens.focal_px() / (kLeastScale_px_mm * pixel_ratio);
    const auto point = [&](std::uint32_t triangle, std::size_t corner) {
        const float* p = &points_mm[3 * std::size_t(triangles[3 * std::size_t(triangle) + corner])];
        return Point3{p[0], p[1], p[2]};
    };
    std::vector<std::uint32_t> well;
    for (const std::uint32_t t : shown) {
        const Point3 a = point(t, 0), b = point(t, 1), c = point(t, 2);
        const Vector3 normal = cross(b - a, c - a);
        const Vector3 ray = interpolate(interpolate(a, b, 0.5), c, 1.0 / 3) - pose.eye_mm;
        const bool near = dot(ray, pose.forward) <= farthest_mm;
        if (near && std::abs(dot(normal, ray)) >= least_cosine * length(normal) * length(ray))
            well.push_back(t);
    }
    return well;
}

}  // namespace vicon::viewer

#include "curve.h"

#include <algorithm>
#include <cmath>

namespace vicon::phantom {
namespace {

/// Uniform cubic B-spline through control values.
template <class Value>
Value spline(const std::vector<Value>& control, double at, auto&& combine)
{
    const int span = std::clamp(int(at), 0, int(control.size()) - 2);
    const double t = at - span, u = 1 - t;
    const double w[4] = {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                         t * t * t / 6};
    const auto value = [&](int n) { return control[std::size_t(std::clamp(n, 0, int(control.size()) - 1))]; };
    return combine(w, value(span - 1), value(span), value(span + 1), value(span + 2));
}

void addFrames(Course& course)
{
    auto& s = course.samples;
    const std::size_t last = s.size() - 1;
    for (std::size_t n = 0; n <= last; ++n)
        s[n].tangent = normalized(s[std::min(n + 1, last)].position_mm - s[n == 0 ? 0 : n - 1].position_mm);
    for (std::size_t n = 1; n < last; ++n) {
        s[n].bend = (s[n + 1].tangent - s[n - 1].tangent) / (2 * course.step_mm);
        s[n].curvature = length(s[n].bend);
    }
    const Vector3 front{0, -1, 0};
    Vector3 normal = normalized(front - s[0].tangent * dot(front, s[0].tangent));
    for (CourseSample& sample : s) {
        normal = normalized(normal - sample.tangent * dot(normal, sample.tangent));
        sample.normal = normal;
        sample.binormal = cross(sample.tangent, normal);
    }
}

}  // namespace

Point3 splinePoint(const std::vector<Point3>& control, double at)
{
    return spline(control, at, [](const double* w, Point3 a, Point3 b, Point3 c, Point3 d) {
        return Point3{w[0] * a.x + w[1] * b.x + w[2] * c.x + w[3] * d.x,
                      w[0] * a.y + w[1] * b.y + w[2] * c.y + w[3] * d.y,
                      w[0] * a.z + w[1] * b.z + w[2] * c.z + w[3] * d.z};
    });
}

double splineValue(const std::vector<double>& control, double at)
{
    return spline(control, at, [](const double* w, double a, double b, double c, double d) {
        return w[0] * a + w[1] * b + w[2] * c + w[3] * d;
    });
}

Course curveThrough(const std::vector<Bead>& beads)
{
    constexpr int kFine = 16;
    std::vector<Point3> positions;
    std::vector<double> radii, mobilities;
    for (const Bead& bead : beads) {
        positions.push_back(bead.position_mm);
        radii.push_back(bead.radius_mm);
        mobilities.push_back(bead.mobility);
    }
    const std::size_t count = (beads.size() - 1) * kFine + 1;
    std::vector<double> along(count, 0);
    std::vector<Point3> fine(count);
    for (std::size_t n = 0; n < count; ++n) {
        fine[n] = splinePoint(positions, double(n) / kFine);
        if (n > 0)
            along[n] = along[n - 1] + distance(fine[n - 1], fine[n]);
    }
    Course course;
    const auto steps = std::size_t(std::round(along.back()));
    course.step_mm = along.back() / double(steps);
    std::size_t n = 0;
    for (std::size_t m = 0; m <= steps; ++m) {
        const double station = std::min(course.step_mm * double(m), along.back());
        while (n + 2 < count && along[n + 1] < station)
            ++n;
        const double at = (double(n) + (station - along[n]) / (along[n + 1] - along[n])) / kFine;
        CourseSample sample;
        sample.position_mm = splinePoint(positions, at);
        sample.radius_mm = splineValue(radii, at);
        sample.mobility = splineValue(mobilities, at);
        course.samples.push_back(sample);
    }
    addFrames(course);
    return course;
}

}  // namespace vicon::phantom

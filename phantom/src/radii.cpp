#include "radii.h"

#include <algorithm>
#include <cmath>

#include "curve.h"
#include "loops.h"

namespace vicon::phantom {
namespace {

constexpr double kCurvatureGoal = 0.85;  // of radius x curvature; 0.9 is the limit
constexpr double kNarrowest = 0.62;      // of the usual radius; narrower: redraw
constexpr double kSlope = 0.35;          // greatest change of the radius along the curve

}  // namespace

void shapeRadii(Course& course, Position position, Random& random)
{
    const Vector3 up = -gravityOf(position);
    std::vector<double> wander(course.samples.size() / 60 + 4);
    for (double& value : wander)
        value = 1 + 0.07 * std::clamp(random.normal(), -2.0, 2.0);
    for (std::size_t n = 0; n < course.samples.size(); ++n) {
        CourseSample& s = course.samples[n];
        s.radius_mm *=
            splineValue(wander, double(n) / 60 + 1) * (1 + 0.06 * std::tanh(dot(s.position_mm - Point3{}, up) / 60));
        if (s.curvature > 0)
            s.radius_mm = std::min(s.radius_mm, kCurvatureGoal / s.curvature);
    }
}

void distend(Course& course, const CourseOptions& options)
{
    constexpr double kReach_mm = 100, kMost = 0.15;
    Random random(options.seed, "distension", std::uint64_t(options.position));
    std::vector<double> knots(std::size_t(course.length_mm() / kReach_mm) + 4);
    for (double& knot : knots)
        knot = random.uniform(-kMost, kMost) * 1.4;  // what the spline takes off
    for (std::size_t n = 0; n < course.samples.size(); ++n) {
        CourseSample& s = course.samples[n];
        s.radius_mm *= std::exp(std::clamp(splineValue(knots, course.stationOf(n) / kReach_mm + 1), -kMost, kMost));
        if (s.curvature > 0)
            s.radius_mm = std::min(s.radius_mm, kCurvatureGoal / s.curvature);
    }
}

void limitSlope(Course& course)
{
    auto& s = course.samples;
    const double step = kSlope * course.step_mm;
    for (std::size_t n = 1; n < s.size(); ++n)
        s[n].radius_mm = std::min(s[n].radius_mm, s[n - 1].radius_mm + step);
    for (std::size_t n = s.size() - 1; n-- > 0;)
        s[n].radius_mm = std::min(s[n].radius_mm, s[n + 1].radius_mm + step);
}

void narrowBetweenLoops(Course& course, double separation_mm, double least_wall_mm,
                        const std::vector<Contact>& contacts)
{
    auto& s = course.samples;
    const double last = double(s.size() - 1), length_mm = course.length_mm();
    std::vector<double> limit(s.size(), 1e9);
    eachLoopPair(course, 2, [&](std::size_t a, std::size_t b, double apart) {
        const bool touching = inContact(contacts, double(a) / last, double(b) / last, length_mm);
        const double excess = s[a].radius_mm + s[b].radius_mm + (touching ? least_wall_mm : separation_mm) - apart;
        if (excess <= 0)
            return;
        limit[a] = std::min(limit[a], s[a].radius_mm - excess / 2);
        limit[b] = std::min(limit[b], s[b].radius_mm - excess / 2);
    });
    for (std::size_t n = 0; n < s.size(); ++n)
        s[n].radius_mm = std::min(s[n].radius_mm, limit[n]);
    limitSlope(course);
}

void smoothRadii(Course& course)
{
    auto& s = course.samples;
    constexpr int kReach = 12;
    std::vector<double> smooth(s.size());
    for (int n = 0; n < int(s.size()); ++n) {
        double sum = 0, weights = 0;
        for (int m = std::max(0, n - kReach); m <= std::min(int(s.size()) - 1, n + kReach); ++m) {
            const double w = std::exp(-0.5 * (m - n) * (m - n) / 16.0);
            sum += w * s[std::size_t(m)].radius_mm;
            weights += w;
        }
        smooth[std::size_t(n)] = sum / weights;
    }
    for (std::size_t n = 0; n < s.size(); ++n)
        s[n].radius_mm = smooth[n];
}

bool closeContacts(Course& course, const std::vector<Contact>& contacts)
{
    auto& s = course.samples;
    const double last = double(s.size() - 1), length_mm = course.length_mm();
    for (const Contact& contact : contacts) {
        std::size_t a = 0, b = 0;
        double slack = 1e9;
        eachLoopPair(course, 1, [&](std::size_t i, std::size_t j, double apart) {
            if (inContact({contact}, double(i) / last, double(j) / last, length_mm) &&
                apart - s[i].radius_mm - s[j].radius_mm < slack) {
                slack = apart - s[i].radius_mm - s[j].radius_mm;
                a = i, b = j;
            }
        });
        const double widen = (slack - contact.wall_mm) / 2;
        if (slack > 1e8 || std::abs(widen) > 5)
            return false;
        for (std::size_t n = 0; n < s.size(); ++n)
            for (const std::size_t centre : {a, b}) {
                const double d = (double(n) - double(centre)) / 12;
                s[n].radius_mm += widen * std::exp(-0.5 * d * d);
            }
    }
    return true;
}

bool narrowed(const Course& course, const std::vector<Bead>& beads)
{
    for (std::size_t n = 0; n < course.samples.size(); ++n) {
        const std::size_t bead = n * (beads.size() - 1) / (course.samples.size() - 1);
        if (course.samples[n].radius_mm < kNarrowest * beads[bead].radius_mm)
            return true;
    }
    return false;
}

}  // namespace vicon::phantom

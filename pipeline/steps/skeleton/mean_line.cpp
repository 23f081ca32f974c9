#include "skeleton/mean_line.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "vicon/core/nearest_on_segment.h"

namespace vicon::steps {
namespace {

/// Lines of one lumen differ by so many points at most in where along them a place lies: 60 mm at the usual steps.
constexpr std::size_t kAside_points = 60;

Point3 nearestOn(const Polyline& line, std::size_t about, Point3 p)
{
    Point3 nearest = line[std::min(about, line.size() - 1)];
    double least_mm = std::numeric_limits<double>::infinity();
    const std::size_t from = about > kAside_points ? about - kAside_points : 0;
    for (std::size_t n = from; n + 1 < std::min(line.size(), about + kAside_points); ++n) {
        const Point3 on_line = interpolate(line[n], line[n + 1], nearestOnSegment(line[n], line[n + 1], p));
        if (const double away_mm = distance(on_line, p); away_mm < least_mm) {
            least_mm = away_mm;
            nearest = on_line;
        }
    }
    return nearest;
}

}  // namespace

Polyline halfwayTo(const Polyline& line, const Polyline& to, const DistanceProbe& wall)
{
    Polyline out = to;
    for (std::size_t n = 0; n < out.size(); ++n)
        if (const Point3 p = interpolate(line[n], to[n], 0.5); wall.inside(p))
            out[n] = p;
    return out;
}

Polyline meanLine(const std::vector<Polyline>& lines, const DistanceProbe& wall)
{
    const Polyline& last = lines.back();
    Polyline mean = last;
    tbb::parallel_for(std::size_t(0), last.size(), [&](std::size_t n) {
        Vector3 sum = last[n] - Point3{};
        for (std::size_t other = 0; other + 1 < lines.size(); ++other) {
            const Polyline& line = lines[other];
            const std::size_t about = n * (line.size() - 1) / std::max<std::size_t>(1, last.size() - 1);
            sum += nearestOn(line, about, last[n]) - Point3{};
        }
        mean[n] = keptInside(Point3{} + sum / double(lines.size()), last[n], wall);
    });
    return mean;
}

}  // namespace vicon::steps

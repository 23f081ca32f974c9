#include "skeleton/path_balls.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>

namespace vicon::steps {
namespace {

constexpr double kApart_mm = 0.5;  // of the balls, so that those of a narrow tube leave no gaps between them
// Of the distance to the wall. Chosen on the four shapes of the reference data: with 0.5 and 0.75 all overlap by more
// than 0.98 with the given lines, with 1 two of them by 0.977 and 0.969.
constexpr double kShare = 0.75;

/// The middle of the largest ball about a point: uphill in wall distance, a voxel or less at a time.
Point3 widestAbout(Point3 p, const DistanceProbe& wall)
{
    const double step_mm = wall.smallestSpacing_mm();
    constexpr std::array<Vector3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (;;) {
        Vector3 uphill;
        for (const Vector3 axis : axes)
            uphill += axis * (wall.at(p + axis * step_mm) - wall.at(p - axis * step_mm));
        if (length(uphill) <= 0)
            return p;
        const Point3 next = p + normalized(uphill) * step_mm;
        if (wall.at(next) <= wall.at(p))
            return p;
        p = next;
    }
}

}  // namespace

PathBalls::PathBalls(const Polyline& path, const DistanceProbe& wall)
{
    const auto add = [&](Point3 p, double radius_mm) { balls_.push_back({p, kShare * radius_mm}); };
    for (std::size_t n = 0; n < path.size(); ++n) {
        if (n > 0) {
            const double before_mm = wall.at(path[n - 1]), here_mm = wall.at(path[n]);
            const int parts = int(std::ceil(distance(path[n - 1], path[n]) / kApart_mm));
            for (int m = 1; m < parts; ++m) {
                const double t = double(m) / parts;
                add(interpolate(path[n - 1], path[n], t), std::lerp(before_mm, here_mm, t));
            }
        }
        const Point3 centre = wall.overTube(path[n]) ? widestAbout(path[n], wall) : path[n];
        add(centre, wall.at(centre));
    }
}

Polyline PathBalls::hold(Polyline line) const
{
    // Lines run along the path, so the ball that holds one point mostly lies near the one that held that before.
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, line.size(), 64), [&](const auto& stretch) {
        std::size_t before = stretch.begin() * balls_.size() / line.size();
        for (std::size_t n = stretch.begin(); n < stretch.end(); ++n)
            if (const std::size_t holding = holderOf(line[n], before); holding < balls_.size())
                before = holding;
            else
                line[n] = held(line[n]);
    });
    return line;
}

std::size_t PathBalls::holderOf(Point3 p, std::size_t about) const
{
    const auto holds = [&](std::size_t n) { return distance(balls_[n].centre, p) <= balls_[n].radius_mm; };
    for (std::size_t off = 0; off < balls_.size(); ++off) {
        if (about + off < balls_.size() && holds(about + off))
            return about + off;
        if (off <= about && holds(about - off))
            return about - off;
    }
    return balls_.size();
}

Point3 PathBalls::held(Point3 p) const
{
    double least_mm = std::numeric_limits<double>::infinity();
    const Ball* nearest = nullptr;
    for (const Ball& ball : balls_) {
        if (const double outside_mm = distance(ball.centre, p) - ball.radius_mm; outside_mm < least_mm) {
            least_mm = outside_mm;
            nearest = &ball;
        }
    }
    return nearest ? interpolate(nearest->centre, p, nearest->radius_mm / (nearest->radius_mm + least_mm)) : p;
}

}  // namespace vicon::steps

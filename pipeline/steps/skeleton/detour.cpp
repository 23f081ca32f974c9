#include "skeleton/detour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace vicon::steps {
namespace {

// A tube is at most 12 mm thick and lies anywhere in the rectum; phantom 1 and the prone reference scan.
constexpr double kDetourRunUp_mm = 12;  // before and after a stretch outside the lumen, in which the curve swings out
constexpr double kFarthest_mm = 16;     // from the middle of the rectum
constexpr double kRing_mm = 1;          // between the rings of places that are tried, and
constexpr int kAngles = 24;             // how many there are on each
constexpr double kClear_mm = 1.5;       // wished distance from the wall and from the tube
constexpr double kOffCost = 0.02, kClearCost = 1, kChangeCost = 1;  // per mm² of each
// Beside a bend, above or below it rather than outside or inside: so the stations stay those of the middle.
constexpr double kLongerCost = 50;
constexpr int kRelaxations = 30;  // of the offsets, a Gaussian of 4 steps

struct Offset {
    double u = 0, v = 0;
};

std::vector<Offset> offsets()
{
    std::vector<Offset> all{{}};
    for (double r = kRing_mm; r <= kFarthest_mm; r += kRing_mm)
        for (int n = 0; n < kAngles; ++n) {
            const double angle = 2 * std::numbers::pi * n / kAngles;
            all.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
    return all;
}

double between(Offset a, Offset b)
{
    return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
}

/// A stretch of a curve, and where its points may go.
struct DetourStretch {
    std::size_t from = 0, to = 0;  ///< numbers of its first and last point
    bool free_start = false, free_end = false;
};

/// The cheapest offset of each point of a stretch: a dynamic programme over rings and angles.
std::vector<Offset> cheapest(const Polyline& line, const std::vector<Frame>& frames, const DetourStretch& stretch,
                             const DistanceProbe& wall)
{
    constexpr double kNever = std::numeric_limits<double>::infinity();  // a way through the wall
    const std::vector<Offset> all = offsets();
    const std::size_t count = stretch.to - stretch.from + 1;
    std::vector<std::vector<int>> before(count, std::vector<int>(all.size(), -1));
    std::vector<double> cost(all.size(), kNever), next(all.size());
    std::vector<Point3> points(all.size()), next_points(all.size());
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t at = stretch.from + n;
        const bool fixed = (n == 0 && !stretch.free_start) || (n + 1 == count && !stretch.free_end);
        for (std::size_t c = 0; c < all.size(); ++c) {
            next[c] = kNever;
            const Point3 p = line[at] + frames[at].u * all[c].u + frames[at].v * all[c].v;
            if ((fixed && c > 0) || !wall.inside(p))
                continue;
            const double close = std::max(0.0, kClear_mm - wall.at(p));
            const double own = kOffCost * between(all[c], {}) + kClearCost * close * close;
            double best = n == 0 ? 0 : kNever;
            for (std::size_t b = 0; n > 0 && b < all.size(); ++b) {
                if (!std::isfinite(cost[b]))
                    continue;
                const double longer = distance(points[b], p) - distance(line[at - 1], line[at]);
                const double so_far = cost[b] + kChangeCost * between(all[b], all[c]) + kLongerCost * longer * longer;
                if (so_far < best) {
                    best = so_far;
                    before[n][c] = int(b);
                }
            }
            next_points[c] = p;
            next[c] = best + own;
        }
        cost.swap(next);
        points.swap(next_points);
    }
    const auto least = std::min_element(cost.begin(), cost.end());
    if (!std::isfinite(*least))
        return {};
    std::vector<Offset> found(count);
    int c = int(least - cost.begin());
    for (std::size_t n = count; n-- > 0; c = before[n][std::size_t(c)])
        found[n] = all[std::size_t(c)];
    return found;
}

/// Offsets without the steps of the rings; a fixed end stays, a free one goes on straight.
std::vector<Offset> evenedOffsets(std::vector<Offset> offsets, const DetourStretch& stretch)
{
    for (int round = 0; round < kRelaxations; ++round) {
        std::vector<Offset> even = offsets;
        for (std::size_t n = 0; n < offsets.size(); ++n) {
            if ((n == 0 && !stretch.free_start) || (n + 1 == offsets.size() && !stretch.free_end))
                continue;
            const Offset a = offsets[n > 0 ? n - 1 : n], b = offsets[std::min(n + 1, offsets.size() - 1)];
            even[n] = {(a.u + 2 * offsets[n].u + b.u) / 4, (a.v + 2 * offsets[n].v + b.v) / 4};
        }
        offsets.swap(even);
    }
    return offsets;
}

/// Moves the points of a stretch evenly; where that would leave the lumen, nearer to the programme's own steps.
void moveAside(Polyline& line, const std::vector<Frame>& frames, const DetourStretch& stretch,
               const DistanceProbe& wall)
{
    const std::vector<Offset> found = cheapest(line, frames, stretch, wall);
    if (found.empty())
        return;
    const std::vector<Offset> even = evenedOffsets(found, stretch);
    for (std::size_t n = 0; n < found.size(); ++n) {
        const std::size_t at = stretch.from + n;
        const auto moved = [&](double t) {
            return line[at] + frames[at].u * std::lerp(even[n].u, found[n].u, t) +
                   frames[at].v * std::lerp(even[n].v, found[n].v, t);
        };
        double t = 0;
        while (t < 1 && !wall.inside(moved(t)))
            t = std::min(1.0, t + 0.25);
        line[at] = moved(t);
    }
}

}  // namespace

Polyline besideTube(const Polyline& line, const DistanceProbe& wall, double step_mm)
{
    Polyline out = line;
    const auto run_up = std::size_t(kDetourRunUp_mm / step_mm);
    const std::vector<Frame> frames = framesAlong(line, std::max(std::size_t(1), std::size_t(3 / step_mm)));
    for (std::size_t n = 0; n < line.size(); ++n) {
        if (wall.inside(line[n]))
            continue;
        std::size_t last = n;
        for (std::size_t m = n; m < line.size() && m <= last + 2 * run_up; ++m)
            if (!wall.inside(line[m]))
                last = m;
        DetourStretch stretch{n > run_up ? n - run_up : 0, std::min(line.size() - 1, last + run_up)};
        stretch.free_start = stretch.from == 0;
        stretch.free_end = stretch.to + 1 == line.size();
        moveAside(out, frames, stretch, wall);
        n = stretch.to;
    }
    return out;
}

}  // namespace vicon::steps

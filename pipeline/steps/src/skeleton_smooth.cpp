#include "skeleton_smooth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vicon::steps {
namespace {

// The window, the smoothing and the percentile were chosen on phantoms 1 (supine) and 3 (supine), full size.
constexpr double kTipWindow_mm = 20;     // how far ahead the lumen is looked at to tell a tip from the lumen
constexpr double kBaseSmoothing_mm = 8;  // of the line from which rays start: about a third of a haustrum
constexpr double kPercentile = 0.5;      // of the radii per angle: passes over folds, which are short
constexpr double kPercentileWindow_mm = 25;
constexpr double kTangent_mm = 3;
constexpr double kTipRadiusOver_mm = 12;  // of the curve, for the radius at its end
constexpr int kOwnBase = 4;               // of the recentrings, the last so many start from the line itself
constexpr double kMostMoved_mm = 10;      // of an end of the curve, when the lumen's tip is measured from it

Vector3 tangentAt(const Polyline& line, std::size_t n, std::size_t reach)
{
    const std::size_t from = n > reach ? n - reach : 0, to = std::min(line.size() - 1, n + reach);
    return normalized(line[to] - line[from]);
}

/// How far the lumen reaches from a point along a unit vector: steps of the wall distance never pass the wall.
double reach(const DistanceProbe& wall, Point3 from, Vector3 along, double limit_mm)
{
    const double voxel = wall.smallestSpacing_mm();
    double s = 0;
    while (s < limit_mm) {
        const double d = wall.at(from + along * s);
        if (d < 0.15 * voxel)
            break;
        s += std::max(0.9 * d, 0.15 * voxel);
    }
    return std::min(s, limit_mm);
}

using Radii = std::vector<std::vector<float>>;  // [angle][point]

Radii sampleRadii(const Polyline& line, const std::vector<Frame>& frames, const DistanceProbe& wall, int rays)
{
    Radii radii(std::size_t(rays), std::vector<float>(line.size()));
    tbb::parallel_for(std::size_t(0), line.size(), [&](std::size_t n) {
        const double limit_mm = 3 * wall.at(line[n]) + 5;
        for (int r = 0; r < rays; ++r) {
            const double angle = 2 * std::numbers::pi * r / rays;
            const Vector3 along = frames[n].u * std::cos(angle) + frames[n].v * std::sin(angle);
            radii[std::size_t(r)][n] = float(reach(wall, line[n], along, limit_mm));
        }
    });
    return radii;
}

std::vector<float> percentileAlong(const std::vector<float>& values, std::size_t half_window)
{
    std::vector<float> out(values.size()), window;
    for (std::size_t n = 0; n < values.size(); ++n) {
        const std::size_t from = n > half_window ? n - half_window : 0;
        const std::size_t to = std::min(values.size() - 1, n + half_window);
        window.assign(values.begin() + std::ptrdiff_t(from), values.begin() + std::ptrdiff_t(to + 1));
        const auto at = window.begin() + std::lround(kPercentile * double(window.size() - 1));
        std::nth_element(window.begin(), at, window.end());
        out[n] = *at;
    }
    return out;
}

/// The point itself, or as near to it as the lumen allows on the way from a point inside.
Point3 keptInside(Point3 wanted, Point3 inside, const DistanceProbe& wall)
{
    for (const double t : {1.0, 0.75, 0.5, 0.25})
        if (const Point3 p = interpolate(inside, wanted, t); wall.inside(p))
            return p;
    return inside;
}

/// Every point moved to the centroid of its cross-section.
Polyline recentred(const Polyline& line, const DistanceProbe& wall, const SkeletonOptions& options)
{
    const auto frames = framesAlong(line, std::size_t(std::max(1.0, kTangent_mm / options.step_mm)));
    Radii radii = sampleRadii(line, frames, wall, options.rays);
    const auto half = std::size_t(kPercentileWindow_mm / 2 / options.step_mm);
    tbb::parallel_for(std::size_t(0), radii.size(), [&](std::size_t r) { radii[r] = percentileAlong(radii[r], half); });
    Polyline out(line.size());
    for (std::size_t n = 0; n < line.size(); ++n) {
        double area = 0, x = 0, y = 0;
        for (std::size_t r = 0; r < radii.size(); ++r) {
            const double angle = 2 * std::numbers::pi * double(r) / double(radii.size()), d = radii[r][n];
            area += d * d / 2;
            x += d * d * d / 3 * std::cos(angle);
            y += d * d * d / 3 * std::sin(angle);
        }
        const Vector3 shift = area > 0 ? (frames[n].u * x + frames[n].v * y) / area : Vector3{};
        out[n] = keptInside(line[n] + shift, line[n], wall);
    }
    return out;
}

/// The smoothed line, held inside the lumen: points that smoothing moved out of it go back towards the line.
Polyline smoothedInside(const Polyline& line, double sigma_mm, const DistanceProbe& wall,
                        const SkeletonOptions& options)
{
    Polyline out = smoothed(line, sigma_mm, options.step_mm);
    for (std::size_t n = 0; n < out.size(); ++n)
        out[n] = keptInside(out[n], line[n], wall);
    return out;
}

/// Resampling may cut a corner: such points go to the nearest of the line, which is inside.
Polyline resampledInside(const Polyline& line, const DistanceProbe& wall, double step_mm)
{
    Polyline out = resampled(line, step_mm);
    for (Point3& p : out)
        if (!wall.inside(p))
            p = *std::min_element(line.begin(), line.end(),
                                  [&](Point3 a, Point3 b) { return distance(a, p) < distance(b, p); });
    return out;
}

Polyline withoutFirstTip(const Polyline& path, const DistanceProbe& wall)
{
    const Point3 tip = path.front();
    const double tip_mm = wall.at(tip);
    for (std::size_t n = 0; n < path.size(); ++n) {
        double widest = 0;
        for (std::size_t m = n; m < path.size() && distance(path[m], path[n]) <= kTipWindow_mm; ++m)
            widest = std::max(widest, wall.at(path[m]));
        if (distance(path[n], tip) + tip_mm >= widest)
            return {path.begin() + std::ptrdiff_t(std::min(n, path.size() - 2)), path.end()};
    }
    return path;
}

double medianOf(std::vector<double> values)
{
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// How far beyond the first point, in the line's direction, lies the centre of a ball that fills the lumen's tip and is
/// as wide as the lumen after it. The medians are over rays, most of which meet neither a fold nor a rectal tube.
double ballAhead(const Polyline& line, const DistanceProbe& wall, double step_mm)
{
    const std::size_t back = std::min(line.size() - 1, std::size_t(8 / step_mm));
    const Vector3 along = normalized(line.front() - line[back]);
    const Vector3 u = normalized(cross(along, std::abs(along.x) < 0.9 ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
    const Vector3 v = cross(along, u);
    const auto across = [&](int n) {
        return u * std::cos(std::numbers::pi * n / 8) + v * std::sin(std::numbers::pi * n / 8);
    };
    std::vector<double> radii, ahead;
    for (std::size_t m = 0; m < line.size() && distance(line[m], line.front()) <= kTipRadiusOver_mm; ++m)
        for (int n = 0; n < 16; ++n)
            radii.push_back(reach(wall, line[m], across(n), kTipWindow_mm * 2));
    const double radius_mm = medianOf(radii);
    for (const double slope : {0.3, 0.6, 0.9})
        for (int n = 0; n < 16; ++n) {
            const double far = reach(wall, line.front(), normalized(along + across(n) * slope), 3 * radius_mm);
            const double height = far / std::sqrt(1 + slope * slope), off = height * slope;
            ahead.push_back(height - std::sqrt(std::max(0.0, radius_mm * radius_mm - off * off)));
        }
    return medianOf(ahead);
}

/// Lengthens or shortens the line so that it begins one local radius inside the lumen's tip: the path from which it was
/// made may run beside the middle there, and so take the local radius for smaller.
void beginOneRadiusIn(Polyline& line, const DistanceProbe& wall, double step_mm)
{
    const std::size_t back = std::min(line.size() - 1, std::size_t(8 / step_mm));
    const double move_mm = std::clamp(ballAhead(line, wall, step_mm), -kMostMoved_mm, kMostMoved_mm);
    const Vector3 along = normalized(line.front() - line[back]);
    const Point3 first = line.front();
    for (double s = step_mm; s <= move_mm && wall.inside(first + along * s); s += step_mm)
        line.insert(line.begin(), first + along * s);
    const auto cut = std::min(line.size() / 4, std::size_t(std::lround(std::max(0.0, -move_mm) / step_mm)));
    line.erase(line.begin(), line.begin() + std::ptrdiff_t(cut));
}

Polyline gaussian(const Polyline& line, double sigma_mm, double step_mm)
{
    const int half = int(std::ceil(3 * sigma_mm / step_mm));
    const int last = int(line.size()) - 1;
    if (half < 1 || last < 2)
        return line;
    std::vector<double> weights;
    for (int m = -half; m <= half; ++m)
        weights.push_back(std::exp(-0.5 * std::pow(m * step_mm / sigma_mm, 2)));
    // Beyond an end the line goes on as its own point reflection, so that smoothing neither shortens nor bends it.
    const auto at = [&](int n) -> Vector3 {
        const auto point = [&](int m) { return line[std::size_t(std::clamp(m, 0, last))] - Point3{}; };
        if (n < 0)
            return point(0) * 2 - point(-n);
        if (n > last)
            return point(last) * 2 - point(2 * last - n);
        return point(n);
    };
    Polyline out(line.size());
    for (int n = 0; n <= last; ++n) {
        Vector3 sum;
        double weight = 0;
        for (int m = -half; m <= half; ++m) {
            const int nth = m + half;
            const double share = weights[std::size_t(nth)];
            sum += at(n + m) * share;
            weight += share;
        }
        out[std::size_t(n)] = Point3{} + sum / weight;
    }
    return out;
}

}  // namespace

std::vector<Frame> framesAlong(const Polyline& line, std::size_t reach)
{
    std::vector<Frame> frames(line.size());
    Vector3 t = tangentAt(line, 0, reach);
    Vector3 u = std::abs(t.x) < 0.9 ? normalized(cross(t, {1, 0, 0})) : normalized(cross(t, {0, 1, 0}));
    for (std::size_t n = 0; n < line.size(); ++n) {
        t = tangentAt(line, n, reach);
        const Vector3 across = u - t * dot(u, t);
        if (length(across) > 1e-6)
            u = normalized(across);
        frames[n] = {u, cross(t, u)};
    }
    return frames;
}

double DistanceProbe::at(Point3 p) const
{
    const ContinuousIndex3 c = field_.grid.continuousIndexAt(p);
    const int i = int(std::floor(c.i)), j = int(std::floor(c.j)), k = int(std::floor(c.k));
    const double x = c.i - i, y = c.j - j, z = c.k - k;
    const auto value = [&](int a, int b, int d) { return double(field_.valueOr({i + a, j + b, k + d}, 0)); };
    const auto row = [&](int b, int d) { return value(0, b, d) * (1 - x) + value(1, b, d) * x; };
    const auto plane = [&](int d) { return row(0, d) * (1 - y) + row(1, d) * y; };
    return plane(0) * (1 - z) + plane(1) * z;
}

double DistanceProbe::smallestSpacing_mm() const
{
    const auto& spacing = field_.grid.spacing_mm;
    return std::min({spacing[0], spacing[1], spacing[2]});
}

Polyline resampled(const Polyline& line, double step_mm)
{
    double total = 0;
    for (std::size_t n = 1; n < line.size(); ++n)
        total += distance(line[n - 1], line[n]);
    const int count = std::max(1, int(std::lround(total / step_mm)));
    Polyline out{line.front()};
    double walked = 0;
    std::size_t n = 1;
    for (int m = 1; m < count; ++m) {
        const double wanted = total * m / count;
        while (n + 1 < line.size() && walked + distance(line[n - 1], line[n]) < wanted) {
            walked += distance(line[n - 1], line[n]);
            ++n;
        }
        const double piece = distance(line[n - 1], line[n]);
        out.push_back(interpolate(line[n - 1], line[n], piece > 0 ? (wanted - walked) / piece : 0));
    }
    out.push_back(line.back());
    return out;
}

Polyline smoothed(const Polyline& line, double sigma_mm, double step_mm)
{
    // A Gaussian alone pulls a bend of radius R inwards by sigma^2 / 2R, 0.6 mm at 5 and 20 mm: adding the smoothed
    // remainder takes that back and leaves the higher frequencies smoothed.
    Polyline out = gaussian(line, sigma_mm, step_mm), rest(line.size());
    for (std::size_t n = 0; n < line.size(); ++n)
        rest[n] = Point3{} + (line[n] - out[n]);
    rest = gaussian(rest, sigma_mm, step_mm);
    for (std::size_t n = 0; n < line.size(); ++n)
        out[n] += rest[n] - Point3{};
    return out;
}

Polyline withoutTips(const Polyline& path, const DistanceProbe& wall)
{
    Polyline line = withoutFirstTip(path, wall);
    std::reverse(line.begin(), line.end());
    line = withoutFirstTip(line, wall);
    std::reverse(line.begin(), line.end());
    return line;
}

Polyline centredCurve(const Polyline& path, const DistanceProbe& wall, const SkeletonOptions& options)
{
    Polyline line = resampledInside(withoutTips(path, wall), wall, options.step_mm);
    line = resampledInside(smoothedInside(line, options.path_smoothing_mm, wall, options), wall, options.step_mm);
    for (int n = 0; n < options.recentrings; ++n) {
        // The percentiles are those of a stretch, not of a point: what the line wriggles within such a stretch would
        // stay. So the rays start from a line without wriggles; at last from the line itself, because what was taken
        // from it as wriggles includes a tenth of every bend that is shorter than two such stretches.
        const bool last = n + kOwnBase >= options.recentrings;
        const Polyline base =
            last ? line
                 : resampledInside(smoothedInside(line, kBaseSmoothing_mm, wall, options), wall, options.step_mm);
        line = smoothedInside(recentred(base, wall, options), options.smoothing_mm, wall, options);
        line = resampledInside(line, wall, options.step_mm);
    }
    for (int end = 0; end < 2; ++end) {
        std::reverse(line.begin(), line.end());
        beginOneRadiusIn(line, wall, options.step_mm);
    }
    return resampledInside(line, wall, options.step_mm);
}

}  // namespace vicon::steps

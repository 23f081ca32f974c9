#include "skeleton/smooth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skeleton/ends.h"
#include "skeleton/mean_line.h"
#include "skeleton/path_balls.h"
#include "skeleton/section.h"
#include "skeleton/swings.h"
#include "skeleton/unwind.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 1 and 3 (supine), full size.
constexpr double kBaseSmoothing_mm = 8;  // of the line from which rays start: about a third of a haustrum
constexpr int kFitted = 9;               // of the recentrings, the last so many take the fitted middle
constexpr int kOwnBase = 8;              // of the recentrings, the last so many start from the line itself
// In a wide lumen with folds the middles of sections jump with the line that they are taken across, and recentring does
// not settle: on ctc-prone each round moved the line by 0.8 mm in the mean, and four changes of the tissue step's
// constants, of 0 to 3 of 3,744 ml, moved stations by 11 to 20 mm. Halfway, and the mean of the last rounds, leave 2 mm
// in the mean, 6 at most, where one voxel of 300 is taken from the wall. With a mean of two it is 17 at most, of four
// 4, but the wriggles that it lacks then shorten the curve by 0.1 %: phantom 274's farthest polyp lies 2.03 mm off.
constexpr int kWholeWay = 2;  // the first so many recentrings go all the way
constexpr int kAveraged = 3;  // of the recentrings, the last so many
/// Of the line, for its curvature; chosen on phantoms 3 and 302 to 304.
constexpr double kBend_mm = 10;
/// Of the line where it swings. With 8 mm a tube with folds by turns (skeleton_test) still swings by 3 mm.
constexpr double kSwingSmoothing_mm = 12;

Vector3 tangentAt(const Polyline& line, std::size_t n, std::size_t reach)
{
    const std::size_t from = n > reach ? n - reach : 0, to = std::min(line.size() - 1, n + reach);
    return normalized(line[to] - line[from]);
}

/// The smoothed line, smoother where it swings, and held inside the lumen: points that smoothing moved out of it go
/// back towards the line.
Polyline smoothedInside(const Polyline& line, double sigma_mm, const DistanceProbe& wall,
                        const SkeletonOptions& options)
{
    Polyline out = smoothed(line, sigma_mm, options.step_mm);
    if (sigma_mm < kSwingSmoothing_mm) {
        const Polyline smoother = smoothed(line, kSwingSmoothing_mm, options.step_mm);
        const std::vector<double> swings = swingsOf(line, wall, options.step_mm);
        for (std::size_t n = 0; n < out.size(); ++n)
            out[n] = interpolate(out[n], smoother[n], swings[n]);
    }
    for (std::size_t n = 0; n < out.size(); ++n)
        out[n] = keptInside(out[n], line[n], wall);
    return out;
}

/// Resampling may cut a corner: such points go to the nearest of the line, which is inside.
Polyline resampledInside(const Polyline& line, const DistanceProbe& wall, double step_mm,
                         Between between = Between::lines)
{
    Polyline out = resampled(line, step_mm, between);
    for (Point3& p : out)
        if (!wall.inside(p))
            p = *std::min_element(line.begin(), line.end(),
                                  [&](Point3 a, Point3 b) { return distance(a, p) < distance(b, p); });
    return out;
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

/// A point of the smooth curve through the points: a cubic between two, whose tangents are those of their neighbours.
Point3 onCurve(const Polyline& line, std::size_t n, double t)
{
    const Point3 a = line[n], b = line[n + 1];
    const double whole = distance(a, b);
    // Tangents in millimetres per millimetre, so that unequal neighbours do not make the curve overshoot.
    const auto tangent = [&](std::size_t at) {
        const Point3 p = line[at > 0 ? at - 1 : 0], q = line[std::min(at + 1, line.size() - 1)];
        return normalized(q - p) * whole;
    };
    const double u = 1 - t;
    return Point3{} + (a - Point3{}) * (u * u * (1 + 2 * t)) + (b - Point3{}) * (t * t * (1 + 2 * u)) +
           tangent(n) * (t * u * u) - tangent(n + 1) * (t * t * u);
}

}  // namespace

Vector3 bendAt(const Polyline& line, std::size_t n, double step_mm)
{
    const auto off = std::size_t(kBend_mm / step_mm);
    if (n < off || n + off >= line.size())
        return {};
    return (normalized(line[n + off] - line[n]) - normalized(line[n] - line[n - off])) / (double(off) * step_mm);
}

Point3 keptInside(Point3 wanted, Point3 inside, const DistanceProbe& wall)
{
    for (const double t : {1.0, 0.75, 0.5, 0.25})
        if (const Point3 p = interpolate(inside, wanted, t); wall.inside(p))
            return p;
    return inside;
}

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

DistanceProbe::DistanceProbe(const FieldVolume& wall_mm, const FieldVolume& box_mm) : field_(wall_mm)
{
    if (box_mm.voxels.empty())
        return;
    box_ = &box_mm;
    box_at_ = wall_mm.grid.indexAt(box_mm.grid.origin_mm);
}

std::pair<const FieldVolume&, Index3> DistanceProbe::holding(Index3 v) const
{
    if (box_) {
        const Index3 in_box{v.i - box_at_.i, v.j - box_at_.j, v.k - box_at_.k};
        if (box_->grid.contains(in_box) && box_->grid.contains({in_box.i + 1, in_box.j + 1, in_box.k + 1}))
            return {*box_, in_box};
    }
    return {field_, v};
}

double DistanceProbe::at(Point3 p) const
{
    const ContinuousIndex3 c = field_.grid.continuousIndexAt(p);
    const Index3 low{int(std::floor(c.i)), int(std::floor(c.j)), int(std::floor(c.k))};
    const double x = c.i - low.i, y = c.j - low.j, z = c.k - low.k;
    const auto held = holding(low);
    const auto value = [&field = held.first, v = held.second](int a, int b, int d) {
        return double(field.valueOr({v.i + a, v.j + b, v.k + d}, 0));
    };
    const auto row = [&](int b, int d) { return value(0, b, d) * (1 - x) + value(1, b, d) * x; };
    const auto plane = [&](int d) { return row(0, d) * (1 - y) + row(1, d) * y; };
    return plane(0) * (1 - z) + plane(1) * z;
}

bool DistanceProbe::inside(Point3 p) const
{
    const auto [field, v] = holding(field_.grid.indexAt(p));
    return field.valueOr(v, 0) > 0;
}

bool DistanceProbe::overTube(Point3 p) const
{
    return box_ && at(p) > DistanceProbe(field_).at(p);
}

double DistanceProbe::smallestSpacing_mm() const
{
    const auto& spacing = field_.grid.spacing_mm;
    return std::min({spacing[0], spacing[1], spacing[2]});
}

Polyline resampled(const Polyline& line, double step_mm, Between between)
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
        const double t = piece > 0 ? (wanted - walked) / piece : 0;
        out.push_back(between == Between::lines ? interpolate(line[n - 1], line[n], t) : onCurve(line, n - 1, t));
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

Polyline centredCurve(const Polyline& path, const DistanceProbe& wall, const SkeletonOptions& options)
{
    Polyline line = resampledInside(withoutTips(path, wall), wall, options.step_mm);
    line = resampledInside(smoothedInside(line, options.path_smoothing_mm, wall, options), wall, options.step_mm);
    const Polyline path_line = line;
    const PathBalls balls(path, wall);
    std::vector<Polyline> last_lines;
    for (int n = 0; n < options.recentrings; ++n) {
        // The percentiles are those of a stretch, not of a point: what the line wriggles within such a stretch would
        // stay. So the rays start from a line without wriggles; at last from the line itself, because what was taken
        // from it as wriggles includes a tenth of every bend that is shorter than two such stretches.
        const bool last = n + kOwnBase >= options.recentrings;
        const Polyline base =
            last ? line
                 : resampledInside(smoothedInside(line, kBaseSmoothing_mm, wall, options), wall, options.step_mm);
        const Middle middle = n + kFitted >= options.recentrings ? Middle::fitted : Middle::median;
        line = unwound(base, recentred(base, wall, options.step_mm, options.rays, middle), path_line, wall,
                       options.step_mm);
        line = smoothedInside(line, options.smoothing_mm, wall, options);
        line = balls.hold(n < kWholeWay ? line : halfwayTo(base, line, wall));
        if (n + kAveraged >= options.recentrings)
            last_lines.push_back(line);
        if (n + 1 < options.recentrings)
            line = resampledInside(line, wall, options.step_mm);
    }
    if (!last_lines.empty())
        line = balls.hold(smoothedInside(meanLine(last_lines, wall), options.smoothing_mm / 2, wall, options));
    // Straight lines between the points would cut every bend a little, 0.2 mm of a colon's length.
    return resampledInside(endsOneRadiusIn(line, wall, options.step_mm), wall, options.step_mm, Between::curves);
}

}  // namespace vicon::steps

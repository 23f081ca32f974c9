#include "skeleton_join.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vicon::steps {
namespace {

// Chosen on phantoms 1, 301, 302, 304 and 305, full size.
constexpr double kClosing_mm = 8;     // before a collapsed part the lumen closes, often to one side
constexpr double kRunUp_mm = 25;      // of the curves, evened together with what joins them
constexpr double kUnsure_mm = 2;      // at either end of the way through the cord: it leaves the lumen in a corner
constexpr double kLeastSure = 0.2;    // of the way, in its middle, that is followed however short it is
constexpr double kCurveScale_mm = 4;  // of the curves and
constexpr double kCordScale_mm = 6;   // of the way: what is shorter is evened out
constexpr double kPinned = 1e6;

/// Cuts off the end of a curve beyond the place where the bridge leaves the lumen, and the stretch before it in which
/// the lumen closes: there the curve follows the corners of the wall.
void cutBack(Polyline& curve, Point3 leave)
{
    const auto near = std::min_element(curve.begin(), curve.end(),
                                       [&](Point3 a, Point3 b) { return distance(a, leave) < distance(b, leave); });
    const auto least = curve.begin() + std::ptrdiff_t(curve.size() * 3 / 4);
    auto end = std::max(near, least);
    while (end > least && distance(*end, leave) < kClosing_mm)
        --end;
    curve.erase(end + 1, curve.end());
}

/// The stretch in the middle of the way through the cord that is followed.
Polyline sureMiddle(const Polyline& way, double step_mm)
{
    const Polyline even = resampled(way, step_mm);
    const double total = double(even.size() - 1);
    const double off = std::min(kUnsure_mm / step_mm, total * (1 - kLeastSure) / 2);
    const auto first = even.begin() + std::lround(off);
    return {first, std::max(even.end() - std::lround(off), first + 1)};
}

struct Known {
    Polyline points;
    std::vector<double> weights;  ///< 0 where nothing is known

    void add(const Polyline& more, double weight, double step_mm)
    {
        if (!points.empty()) {
            const Point3 from = points.back();
            const int missing = int(std::lround(distance(from, more.front()) / step_mm)) - 1;
            for (int n = 1; n <= missing; ++n) {
                points.push_back(interpolate(from, more.front(), double(n) / (missing + 1)));
                weights.push_back(0);
            }
        }
        points.insert(points.end(), more.begin(), more.end());
        weights.insert(weights.end(), more.size(), weight);
    }
};

/// The line that is nearest to what is known and whose bend changes least: a smoothing spline of the fifth degree, by
/// its normal equations, whose matrix has three diagonals on either side of the middle.
Polyline evened(const Known& known)
{
    constexpr std::size_t kBand = 4;
    constexpr std::array<double, kBand> kThird{-1, 3, -3, 1};
    const std::size_t count = known.points.size();
    std::vector<std::array<double, kBand>> rows(count);  // [row][row - column]
    std::vector<Vector3> right(count);
    for (std::size_t n = 0; n < count; ++n) {
        rows[n][0] += known.weights[n];
        right[n] = (known.points[n] - Point3{}) * known.weights[n];
        for (std::size_t a = 0; n + 3 < count && a < kBand; ++a)
            for (std::size_t b = 0; b <= a; ++b)
                rows[n + a][a - b] += kThird[a] * kThird[b];
    }
    // Cholesky's method within the band.
    for (std::size_t r = 0; r < count; ++r)
        for (std::size_t off = std::min(r, kBand - 1) + 1; off-- > 0;) {
            const std::size_t c = r - off;
            double sum = rows[r][off];
            for (std::size_t k = r > kBand - 1 ? r - (kBand - 1) : 0; k < c; ++k)
                if (c - k < kBand)
                    sum -= rows[r][r - k] * rows[c][c - k];
            rows[r][off] = off == 0 ? std::sqrt(std::max(sum, 1e-12)) : sum / rows[c][0];
        }
    for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t off = 1; off < kBand && off <= r; ++off)
            right[r] += right[r - off] * -rows[r][off];
        right[r] = right[r] / rows[r][0];
    }
    for (std::size_t r = count; r-- > 0;) {
        for (std::size_t off = 1; off < kBand && r + off < count; ++off)
            right[r] += right[r + off] * -rows[r + off][off];
        right[r] = right[r] / rows[r][0];
    }
    Polyline out;
    for (const Vector3& v : right)
        out.push_back(Point3{} + v);
    return out;
}

double weightFor(double scale_mm, double step_mm)
{
    return std::pow(step_mm / scale_mm, 6);
}

}  // namespace

Polyline joined(Polyline& before, const Polyline& way, Polyline& after, const DistanceProbe& open, double step_mm)
{
    cutBack(before, way.front());
    std::reverse(after.begin(), after.end());
    cutBack(after, way.back());
    std::reverse(after.begin(), after.end());
    const auto run = [&](const Polyline& curve) {
        return std::ptrdiff_t(std::min(curve.size(), std::size_t(kRunUp_mm / step_mm)));
    };
    Known known;
    known.add({before.end() - run(before), before.end()}, weightFor(kCurveScale_mm, step_mm), step_mm);
    known.add(sureMiddle(way, step_mm), weightFor(kCordScale_mm, step_mm), step_mm);
    known.add({after.begin(), after.begin() + run(after)}, weightFor(kCurveScale_mm, step_mm), step_mm);
    known.weights.front() = known.weights.back() = kPinned;
    before.erase(before.end() - run(before) + 1, before.end());
    after.erase(after.begin(), after.begin() + run(after) - 1);
    const Polyline line = resampled(evened(known), step_mm);
    std::size_t from = 0, to = line.size() - 1;
    while (from + 2 < to && open.inside(line[from + 1]))
        ++from;
    while (to > from + 1 && open.inside(line[to - 1]))
        --to;
    const auto begin = line.begin();
    before.insert(before.end(), begin + 1, begin + std::ptrdiff_t(from) + 1);
    after.insert(after.begin(), begin + std::ptrdiff_t(to), line.end() - 1);
    return {begin + std::ptrdiff_t(from), begin + std::ptrdiff_t(to) + 1};
}

}  // namespace vicon::steps

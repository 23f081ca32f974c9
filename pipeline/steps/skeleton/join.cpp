#include "skeleton/join.h"

#include <algorithm>
#include <cmath>

#include "skeleton/evened_line.h"
#include "skeleton/section.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 1, 301, 302, 304 and 305, full size; run-up and rounds on 202, 206, 212, 218, 221, 233, 238, 242.
constexpr double kClosing_mm = 8;     // before a collapsed part the lumen closes, often to one side
constexpr double kRunUp_mm = 70;      // of the curves, evened together with what joins them
constexpr double kKept_mm = 26;       // of that: the wall there was fitted from both sides before
constexpr int kRounds = 4;            // of moving the run-ups to the middle of the lumen
constexpr double kUnsure_mm = 2;      // at either end of the way through the cord: it leaves the lumen in a corner
constexpr double kLeastSure = 0.2;    // of the way, in its middle, that is followed however short it is
constexpr double kCurveScale_mm = 4;  // of the curves and
constexpr double kCordScale_mm = 6;   // of the way: what is shorter is evened out

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

/// Where a line over a collapsed part leaves the lumen and where it enters it again.
struct Collapsed {
    std::size_t from = 0, to = 0;
};

Collapsed collapsedOn(const Polyline& line, const DistanceProbe& open)
{
    Collapsed part{0, line.size() - 1};
    while (part.from + 2 < part.to && open.inside(line[part.from + 1]))
        ++part.from;
    while (part.to > part.from + 1 && open.inside(line[part.to - 1]))
        --part.to;
    return part;
}

Polyline evenedOver(const Polyline& before, const Polyline& middle, const Polyline& after, double step_mm)
{
    KnownLine known;
    known.add(before, weightFor(kCurveScale_mm, step_mm), step_mm);
    if (!middle.empty())
        known.add(middle, weightFor(kCordScale_mm, step_mm), step_mm);
    known.add(after, weightFor(kCurveScale_mm, step_mm), step_mm);
    known.weights.front() = known.weights.back() = kPinned;
    return resampled(evened(known), step_mm);
}

/// The line moved to the middle of the lumen on both sides of the collapsed part: the wall is fitted over it, so that
/// the fit has wall before and behind a place right beside the collapsed part.
Polyline recentredBeside(const Polyline& line, const Polyline& middle, const DistanceProbe& open,
                         const SkeletonOptions& options)
{
    const auto steps = [&](double mm) { return std::size_t(mm / options.step_mm); };
    const Collapsed part = collapsedOn(line, open);
    const std::size_t before = part.from - std::min(part.from, steps(kClosing_mm));
    const std::size_t after = std::min(part.to + steps(kClosing_mm), line.size() - 1);
    Polyline moved = recentred(line, open, options.step_mm, options.rays, Middle::fitted);
    for (std::size_t n = 0; n < line.size(); ++n)
        if (std::min(n, line.size() - 1 - n) < steps(kKept_mm))
            moved[n] = line[n];
    return evenedOver({moved.begin(), moved.begin() + std::ptrdiff_t(before) + 1}, middle,
                      {moved.begin() + std::ptrdiff_t(after), moved.end()}, options.step_mm);
}

}  // namespace

Polyline joined(Polyline& before, const Polyline& way, Polyline& after, const DistanceProbe& open,
                const SkeletonOptions& options)
{
    const double step_mm = options.step_mm;
    cutBack(before, way.front());
    std::reverse(after.begin(), after.end());
    cutBack(after, way.back());
    std::reverse(after.begin(), after.end());
    const auto run = [&](const Polyline& curve) {
        return std::ptrdiff_t(std::min(curve.size(), std::size_t(kRunUp_mm / step_mm)));
    };
    const Polyline middle = way.size() > 2 ? sureMiddle(way, step_mm) : Polyline{};
    Polyline line = evenedOver({before.end() - run(before), before.end()}, middle,
                               {after.begin(), after.begin() + run(after)}, step_mm);
    before.erase(before.end() - run(before) + 1, before.end());
    after.erase(after.begin(), after.begin() + run(after) - 1);
    for (int round = 0; round < kRounds; ++round)
        line = recentredBeside(line, middle, open, options);
    const Collapsed part = collapsedOn(line, open);
    const auto begin = line.begin();
    before.insert(before.end(), begin + 1, begin + std::ptrdiff_t(part.from) + 1);
    after.insert(after.begin(), begin + std::ptrdiff_t(part.to), line.end() - 1);
    return {begin + std::ptrdiff_t(part.from), begin + std::ptrdiff_t(part.to) + 1};
}

}  // namespace vicon::steps

#include "polyp_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "polyp_figures.h"
#include "polyp_surroundings.h"

namespace vicon {
namespace {

constexpr int kSections = 48;       // half planes around the axis
constexpr double kSection_mm = 60;  // long, from the axis: over a head of 30 mm and down its stalk

struct Outline : TracedPolyp {
    int lost = 0;   ///< sections without one of their own
    int moved = 0;  ///< sections whose own one does not fit those beside it
};

constexpr double kMostLost = 0.3;  // of the sections may have no rim
constexpr double kOutlier = 1.35;  // times the median of the rims beside it, or one part of it
constexpr int kBeside = 4;         // sections to either side, 30 degrees
constexpr std::size_t kFewest = 3;

/// Takes out rims that lie much farther or nearer than those beside them, and puts in their median.
void evenOut(Outline& outline)
{
    const int count = int(outline.rims.size());
    const std::vector<std::optional<std::size_t>> found = outline.rims;
    for (int n = 0; n < count; ++n) {
        std::vector<std::size_t> beside;
        for (int d = -kBeside; d <= kBeside; ++d)
            if (const auto& other = found[std::size_t((n + d + count) % count)]; d != 0 && other)
                beside.push_back(*other);
        auto& rim = outline.rims[std::size_t(n)];
        const std::size_t points = outline.profiles[std::size_t(n)].points.size();
        if (beside.size() < kFewest || points == 0) {
            rim.reset();
            continue;
        }
        const auto middle = beside.begin() + std::ptrdiff_t(beside.size() / 2);
        std::nth_element(beside.begin(), middle, beside.end());
        const auto usual = double(*middle);
        if (!rim || double(*rim) > kOutlier * usual || double(*rim) < usual / kOutlier) {
            outline.moved += rim ? 1 : 0;
            rim = *middle;
        }
        rim = std::min(*rim, points - 1);
    }
}

Outline outlineAround(const SurfacePatch& patch, Point3 top, Vector3 axis)
{
    Outline outline{{top, axis, {}, {}}};
    const Vector3 across = anyAcross(axis), aside = cross(axis, across);
    const auto start = patch.onAxis(top, axis);
    for (int n = 0; n < kSections; ++n) {
        const double angle = 2 * std::numbers::pi * n / kSections;
        const Vector3 out = across * std::cos(angle) + aside * std::sin(angle);
        const auto line = start ? patch.section(*start, axis, out, kSection_mm) : std::vector<Point3>();
        outline.profiles.push_back(polypProfileOf(line, top, axis, out));
        outline.rims.push_back(rimOf(outline.profiles.back()));
        outline.lost += outline.rims.back() ? 0 : 1;
    }
    evenOut(outline);
    return outline;
}

Point3 middleOf(const std::vector<Point3>& points)
{
    Vector3 sum;
    for (const Point3& p : points)
        sum += p - points.front();
    return points.front() + sum / double(points.size());
}

/// The normal of the area that a closed line goes around.
Vector3 normalOf(const std::vector<Point3>& rim, Point3 middle)
{
    Vector3 sum;
    for (std::size_t n = 0; n < rim.size(); ++n)
        sum += cross(rim[n] - middle, rim[(n + 1) % rim.size()] - middle);
    return normalized(sum);
}

constexpr double kAroundClick_mm = 2;
constexpr int kRounds = 4;
constexpr double kLargestGap =
    0.2;  // of the diameter, from a section's rim to the next: 0.08 on walls, 0.25 and more on folds
constexpr int kMostMoved = kSections / 8;

double largestGap_mm(const std::vector<Point3>& rim)
{
    double most = 0;
    for (std::size_t n = 0; n < rim.size(); ++n)
        most = std::max(most, distance(rim[n], rim[(n + 1) % rim.size()]));
    return most;
}

/// Whether a place lies in the outlined head, or as near to it as a click may be.
bool holds(const Outline& outline, Point3 middle, Point3 place)
{
    const Vector3 off = place - outline.top, across = anyAcross(outline.axis), aside = cross(outline.axis, across);
    const double angle = std::atan2(dot(off, aside), dot(off, across));
    const auto section = std::size_t(std::lround(angle / (2 * std::numbers::pi) * kSections) + kSections) % kSections;
    const double up_mm = dot(off, outline.axis), base_mm = dot(middle - outline.top, outline.axis);
    return outline.rims[section] && headHolds(outline.profiles[section], *outline.rims[section], base_mm,
                                              length(off - outline.axis * up_mm), up_mm, kPolypCatch_mm);
}

constexpr const char* kNotItsOwnEdge = "its edge lies on a fold, or on another polyp";

TriedOutline refused(std::string why)
{
    return {{{}, {}, std::move(why)}, false};
}

}  // namespace

TriedOutline outlineFrom(const SurfacePatch& patch, const InsideView& lumen, Point3 from, Point3 place,
                         const BlurAndNoise& scan, const Progress* wanted)
{
    Point3 top = from;
    Outline outline = outlineAround(patch, top, patch.normalNear(top, kAroundClick_mm));
    Point3 middle;
    for (int round = 0;; ++round) {
        if (wanted)
            wanted->check();
        const std::vector<Point3> rim = outline.rimPoints();
        if (rim.size() < std::size_t(kSections) / 4)
            return refused("it has no edge");
        middle = middleOf(rim);
        outline.axis = normalOf(rim, middle);
        if (round == kRounds)
            break;
        // The next sections leave from over the rim's middle.
        double radius_mm = 0;
        for (const Point3& p : rim)
            radius_mm += distance(p, middle) / double(rim.size());
        top = patch.highest(middle, outline.axis, std::max(1.0, radius_mm / 4));
        outline = outlineAround(patch, top, outline.axis);
    }
    if (outline.lost > kMostLost * kSections)
        return refused("it has no edge all around");
    const HeadChord chord = largestChordOf(outline);
    if (largestGap_mm(outline.rimPoints()) > kLargestGap * chord.length_mm || outline.moved > kMostMoved)
        return refused(kNotItsOwnEdge);
    if (!holds(outline, middle, place))
        return refused("what stands beside the point does not reach to it");
    if (touchesAnother(outline, chord.length_mm))
        return {refused(kNotItsOwnEdge).outline, true};
    if (std::string trouble = fluidTrouble(outline, lumen); !trouble.empty())
        return {refused(std::move(trouble)).outline, true};
    const PolypSize size = figuresOf(outline, chord, middle, scan);
    return {{size, bestPlaneOf(outline, size, lumen.grid.axis, scan), ""}, true};
}

}  // namespace vicon

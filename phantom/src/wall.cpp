#include "wall.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "openness.h"

namespace vicon::phantom {
namespace {

using std::numbers::pi;
constexpr double kWall_mm = 1.6;         // thickness of the distended colon's wall
constexpr double kCollapsed_mm = 6.5;    // outer radius of a collapsed part
constexpr double kNoLumen_mm = -4;       // radius that stands for none
constexpr double kPolypSunk = 0.25;      // of the radius: how far inside the wall line a polyp's centre lies
constexpr double kContactClear_mm = 16;  // no relief this near to a contact between loops
constexpr double kContactFade_mm = 14;

double fade(double distance_mm, double clear_mm, double over_mm)
{
    return std::clamp((distance_mm - clear_mm) / over_mm, 0.0, 1.0);
}

/// Nearest distance to any station in a list.
double distanceTo(const std::vector<double>& stations, double station_mm)
{
    double least = 1e9;
    for (const double s : stations)
        least = std::min(least, std::abs(s - station_mm));
    return least;
}

std::vector<double> contactStations(const DrawnCourse& drawn)
{
    std::vector<double> stations;
    for (const Contact& contact : drawn.contacts)
        for (const double fraction : {contact.fraction_a, contact.fraction_b})
            stations.push_back(fraction * drawn.course.length_mm());
    return stations;
}

double radiusAt(const Course& course, double station_mm)
{
    const double n = std::clamp(station_mm / course.step_mm, 0.0, double(course.samples.size() - 1));
    const auto low = std::min(std::size_t(n), course.samples.size() - 2);
    return std::lerp(course.samples[low].radius_mm, course.samples[low + 1].radius_mm, n - double(low));
}

/// Curvature of the axis towards an angle, the largest within a fold's thickness.
double bendTowards(const Course& course, double station_mm, double angle)
{
    double largest = -1e9;
    for (const double off_mm : {-3.0, 0.0, 3.0}) {
        const CourseSample& at = course.samples[course.sampleAt(station_mm + off_mm)];
        largest = std::max(largest, dot(at.bend, at.normal * std::cos(angle) + at.binormal * std::sin(angle)));
    }
    return largest;
}

struct Shape {
    const Course& course;
    Relief relief;
    std::vector<double> contacts;
    std::vector<CollapsedGap> gaps;
    bool folds;

    /// How strongly haustra and folds are formed: not at the ends, contacts and gaps.
    double strength(double station_mm) const
    {
        const double ends = std::min(station_mm, course.length_mm() - station_mm);
        return folds ? fade(ends, 4, 14) * fade(distanceTo(contacts, station_mm), kContactClear_mm, kContactFade_mm) *
                           openness(gaps, station_mm)
                     : 0;
    }
    double withoutFolds(const std::vector<double>& rings, double station_mm, double angle) const
    {
        const double haustra = 1 - strength(station_mm) * (1 - haustration(relief, rings, station_mm, angle));
        return radiusAt(course, station_mm) * openness(gaps, station_mm) * haustra;
    }
};

template <class Item>
std::vector<Item> near(const std::vector<Item>& all, double station_mm, double reach_mm, auto&& stationOf)
{
    std::vector<Item> close;
    for (const Item& item : all)
        if (std::abs(stationOf(item) - station_mm) < reach_mm)
            close.push_back(item);
    return close;
}

std::vector<double> ringsNear(const Relief& relief, double station_mm)
{
    return near(relief.ring_mm, station_mm, 30, [](double s) { return s; });
}

std::vector<Polyp> placePolyps(const Shape& shape)
{
    std::vector<Polyp> polyps;
    for (const PolypSite& site : shape.relief.polyps) {
        const std::size_t n = shape.course.sampleAt(site.station_mm);
        const CourseSample& at = shape.course.samples[n];
        const double station_mm = shape.course.stationOf(n);
        const double angle = shape.relief.taeniaAngle(station_mm) + site.off_taenia;
        const double out_mm = shape.withoutFolds(ringsNear(shape.relief, station_mm), station_mm, angle) -
                              kPolypSunk * site.diameter_mm / 2;
        const Vector3 outward = at.normal * std::cos(angle) + at.binormal * std::sin(angle);
        polyps.push_back({at.position_mm + outward * out_mm, station_mm, site.diameter_mm, 0});
    }
    return polyps;
}

/// Collapsed parts, clear of ends, polyps, contacts and one another; each position has its own.
std::vector<CollapsedGap> drawGaps(const PhantomOptions& options, const Course& course, Position position,
                                   const std::vector<double>& keep_clear)
{
    Random random(options.seed, "gaps", std::uint64_t(position));
    std::vector<CollapsedGap> gaps;
    for (int tries = 0; int(gaps.size()) < options.gaps && tries < 20000; ++tries) {
        // The left colon collapses most often.
        const double fraction = random.uniform() < 0.7 ? random.uniform(0.12, 0.5) : random.uniform(0.5, 0.85);
        const double from = fraction * course.length_mm(), to = from + random.uniform(10, 40);
        const double clear_mm = kGapRamp_mm + 14;
        bool clear = true;
        for (const double station : keep_clear)
            clear = clear && (station < from - clear_mm || station > to + clear_mm);
        for (const CollapsedGap& other : gaps)
            clear = clear && (other.to_mm < from - 120 || other.from_mm > to + 120);
        if (clear)
            gaps.push_back({from, to});
    }
    std::sort(gaps.begin(), gaps.end(), [](auto& a, auto& b) { return a.from_mm < b.from_mm; });
    return gaps;
}

}  // namespace

Wall Wall::draw(const PhantomOptions& options, const DrawnCourse& drawn, Position position, double reach_mm)
{
    Shape shape{drawn.course, drawn.relief, contactStations(drawn), {}, options.folds};
    Wall wall;
    wall.reach_mm = reach_mm;
    wall.polyps = placePolyps(shape);
    std::vector<double> keep_clear = shape.contacts;
    for (const Polyp& polyp : wall.polyps)
        keep_clear.push_back(polyp.station_mm);
    wall.gaps = shape.gaps = drawGaps(options, drawn.course, position, keep_clear);

    const auto rows = std::size_t(std::ceil(drawn.course.length_mm() / kStep_mm)) + 1;
    wall.lumen_.resize(rows * kAngles);
    wall.outside_.resize(rows * kAngles);
    wall.largest_.resize(rows);
    tbb::parallel_for(std::size_t(0), rows, [&](std::size_t row) {
        const double station_mm = std::min(double(row) * kStep_mm, drawn.course.length_mm());
        const auto rings = ringsNear(shape.relief, station_mm);
        const auto folds = near(shape.relief.folds, station_mm, 14, [](const Fold& f) { return f.station_mm; });
        const double strength = shape.strength(station_mm), open = openness(shape.gaps, station_mm);
        for (int a = 0; a < kAngles; ++a) {
            const double angle = 2 * pi * a / kAngles;
            const double tube = shape.withoutFolds(rings, station_mm, angle);
            const double depth =
                strength * foldDepth_mm(shape.relief, folds,
                                        {station_mm, angle, tube, bendTowards(drawn.course, station_mm, angle)});
            const double outside = std::max(tube + kWall_mm, open < 1 ? kCollapsed_mm : 0);
            wall.lumen(row, a) = float(open > 0 ? tube - depth : kNoLumen_mm);
            wall.outside_[row * kAngles + std::size_t(a)] = float(outside);
            wall.largest_[row] = std::max(wall.largest_[row], float(outside));
        }
    });
    wall.findExtremes();
    return wall;
}

void Wall::findExtremes()
{
    const long rows = long(largest_.size()), reach = std::max(1L, std::lround(reach_mm / kStep_mm));
    narrowest_ = widest_ = lumen_;
    tbb::parallel_for(0L, rows, [&](long row) {
        for (long other = std::max(0L, row - reach); other <= std::min(rows - 1, row + reach); ++other)
            for (std::size_t a = 0; a < kAngles; ++a) {
                const float radius = lumen_[std::size_t(other) * kAngles + a];
                float &low = narrowest_[std::size_t(row) * kAngles + a],
                      &high = widest_[std::size_t(row) * kAngles + a];
                low = std::min(low, radius);
                high = std::max(high, radius);
            }
    });
}

Wall::Sample Wall::at(double station_mm, double angle) const
{
    const double row = std::clamp(station_mm / kStep_mm, 0.0, double(largest_.size() - 1) - 1e-6);
    const double turn = angle / (2 * pi);
    const double column = (turn - std::floor(turn)) * kAngles;
    const auto r = std::size_t(row), c = std::size_t(column) % kAngles, d = (c + 1) % kAngles;
    const double u = row - double(r), v = column - std::floor(column);
    const float *low = &lumen_[r * kAngles], *high = low + kAngles;
    const double near = std::lerp(low[c], low[d], v), far = std::lerp(high[c], high[d], v);
    const double here = std::lerp(low[c], high[c], u), next = std::lerp(low[d], high[d], u);
    const auto interpolated = [&](const std::vector<float>& table) {
        const float *from = &table[r * kAngles], *to = from + kAngles;
        return std::lerp(std::lerp(from[c], from[d], v), std::lerp(to[c], to[d], v), u);
    };
    return {interpolated(narrowest_),           interpolated(widest_), std::lerp(near, far, u), (far - near) / kStep_mm,
            (next - here) * kAngles / (2 * pi), interpolated(outside_)};
}

double Wall::largestOutside_mm(double station_mm) const
{
    const double row = std::clamp(station_mm / kStep_mm, 0.0, double(largest_.size() - 1));
    return largest_[std::size_t(row)];
}

}  // namespace vicon::phantom

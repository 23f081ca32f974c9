#include "stool.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "random.h"
#include "scene.h"

namespace vicon::phantom {
namespace {

constexpr double kSmallest_mm = 5, kLargest_mm = 18;
constexpr double kSunk = 0.3;           // of a lump's radius: how much nearer to the wall line its centre lies
constexpr double kMostOfWidth = 0.45;   // of the lumen's diameter; the rest is left to gas
constexpr double kClearOfTube_mm = 70;  // stations of the rectal tube
constexpr double kClear_mm = 15;        // stations to polyps, gaps and other lumps, beyond the lump's size
constexpr double kFaintest_hu = 250, kDensest_hu = 700;
constexpr int kKnobs = 3;  // balls on a lump's side, so that it is none itself
// A bubble in every cell of such a lattice takes about three tenths of a lump.
constexpr double kBubbleCell_mm = 2.6, kLeastBubble_mm = 0.8, kLargestBubble_mm = 1.3;
constexpr double kThinnestFilm_mm = 0.5, kThickestFilm_mm = 2;

bool isFree(double station_mm, double size_mm, const Wall& wall, const std::vector<StoolLump>& taken)
{
    const double clear_mm = kClear_mm + size_mm;
    return std::none_of(wall.polyps.begin(), wall.polyps.end(),
                        [&](const Polyp& p) { return std::abs(p.station_mm - station_mm) < clear_mm; }) &&
           std::none_of(wall.gaps.begin(), wall.gaps.end(),
                        [&](const CollapsedGap& gap) {
                            return station_mm > gap.from_mm - clear_mm && station_mm < gap.to_mm + clear_mm;
                        }) &&
           std::none_of(taken.begin(), taken.end(),
                        [&](const StoolLump& other) { return std::abs(other.station_mm - station_mm) < clear_mm; });
}

/// One lump at a drawn place; its diameter is 0 where the lumen is too narrow for it.
StoolLump drawLump(Random& random, const Course& course, const Wall& wall)
{
    StoolLump lump;
    lump.station_mm = random.uniform(kClearOfTube_mm, course.length_mm() - 20);
    const CourseSample& at = course.samples[course.sampleAt(lump.station_mm)];
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const double wanted_mm = random.uniform(kSmallest_mm, kLargest_mm);
    lump.density_hu = random.uniform(kFaintest_hu, kDensest_hu);
    lump.airy = random.below(2) == 1;
    lump.seed = random.bits();
    const double away_mm = wall.at(lump.station_mm, angle).lumen_mm;
    lump.diameter_mm = std::min(wanted_mm, kMostOfWidth * (away_mm + at.radius_mm));
    if (lump.diameter_mm < kSmallest_mm)
        lump.diameter_mm = 0;
    const Vector3 outward = at.normal * std::cos(angle) + at.binormal * std::sin(angle);
    lump.position_mm = at.position_mm + outward * (away_mm - (1 - kSunk) * lump.diameter_mm / 2);
    for (int n = 0; n < kKnobs; ++n)
        lump.knobs_mm.push_back(lump.position_mm + anyDirection(random) * (0.25 * lump.diameter_mm));
    return lump;
}

std::uint64_t cellNumber(int i, int j, int k)
{
    constexpr int kOff = 1 << 20;
    return (std::uint64_t(i + kOff) << 42) ^ (std::uint64_t(j + kOff) << 21) ^ std::uint64_t(k + kOff);
}

}  // namespace

std::vector<StoolLump> drawStool(const PhantomOptions& options, const Course& course, const Wall& wall,
                                 Position position)
{
    constexpr int kTries = 40;  // a lump
    Random random(options.seed, "stool", std::uint64_t(position));
    std::vector<StoolLump> lumps;
    for (int tries = 0; tries < kTries * options.stool && int(lumps.size()) < options.stool; ++tries) {
        StoolLump lump = drawLump(random, course, wall);
        if (lump.diameter_mm > 0 && isFree(lump.station_mm, lump.diameter_mm, wall, lumps))
            lumps.push_back(std::move(lump));
    }
    std::sort(lumps.begin(), lumps.end(),
              [](const StoolLump& a, const StoolLump& b) { return a.station_mm < b.station_mm; });
    return lumps;
}

std::vector<TaggingFilm> drawFilms(const PhantomOptions& options, const Wall& wall, Position position)
{
    std::vector<TaggingFilm> films;
    if (!options.film)
        return films;
    Random random(options.seed, "film", std::uint64_t(position));
    for (std::size_t n = 0; n < wall.polyps.size(); ++n) {
        const double thickness_mm = random.uniform(kThinnestFilm_mm, kThickestFilm_mm);
        films.push_back({n, thickness_mm, random.uniform(kFaintest_hu, kDensest_hu)});
    }
    return films;
}

double distanceTo(const StoolLump& lump, Point3 p)
{
    double least_mm = distance(p, lump.position_mm) - 0.35 * lump.diameter_mm;
    for (const Point3 knob : lump.knobs_mm)
        least_mm = std::min(least_mm, distance(p, knob) - 0.25 * lump.diameter_mm);
    return least_mm;
}

double distanceToBubble(const StoolLump& lump, Point3 p)
{
    const auto cell = [](double at_mm) { return int(std::floor(at_mm / kBubbleCell_mm)); };
    double least_mm = 1e9;
    for (int k = cell(p.z) - 1; k <= cell(p.z) + 1; ++k)
        for (int j = cell(p.y) - 1; j <= cell(p.y) + 1; ++j)
            for (int i = cell(p.x) - 1; i <= cell(p.x) + 1; ++i) {
                Random random(lump.seed, "bubble", cellNumber(i, j, k));
                const Point3 middle{(i + random.uniform()) * kBubbleCell_mm, (j + random.uniform()) * kBubbleCell_mm,
                                    (k + random.uniform()) * kBubbleCell_mm};
                least_mm = std::min(least_mm, distance(p, middle) - random.uniform(kLeastBubble_mm, kLargestBubble_mm));
            }
    return least_mm;
}

}  // namespace vicon::phantom

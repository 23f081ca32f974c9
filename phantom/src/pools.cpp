#include "pools.h"

#include <algorithm>
#include <cmath>

namespace vicon::phantom {
namespace {

constexpr double kShallowest_mm = 8, kDeepest_mm = 26;  // depth of a pool at its lowest point
constexpr int kMostPools = 6;
constexpr double kFaintest_hu = 300, kDensest_hu = 900;

/// Height of the floor of the lumen at every sample; very high within gaps.
std::vector<double> floorHeights(const Course& course, const Wall& wall, Vector3 up)
{
    std::vector<double> heights(course.samples.size());
    for (std::size_t n = 0; n < heights.size(); ++n) {
        const CourseSample& s = course.samples[n];
        const double along = dot(s.tangent, up);
        heights[n] = dot(s.position_mm - Point3{}, up) - s.radius_mm * std::sqrt(std::max(0.0, 1 - along * along));
        for (const CollapsedGap& gap : wall.gaps)
            if (course.stationOf(n) >= gap.from_mm && course.stationOf(n) <= gap.to_mm)
                heights[n] = 1e9;
    }
    return heights;
}

struct Basin {
    std::size_t first = 0, last = 0;
    double level_mm = 0;
    double volume = 0;  // relative
};

/// Height above which fluid from sample `n` runs off to a lower place on one side.
double spillHeight(const std::vector<double>& floor, std::size_t n, int direction)
{
    double highest = floor[n];
    for (long m = long(n) + direction; m >= 0 && m < long(floor.size()); m += direction) {
        highest = std::max(highest, floor[std::size_t(m)]);
        if (floor[std::size_t(m)] < floor[n])
            return highest;
    }
    return 1e9;
}

/// The stretch around sample `n` whose floor lies below `level_mm`.
Basin basinAround(const std::vector<double>& floor, std::size_t n, double level_mm)
{
    Basin basin{n, n, level_mm, 0};
    while (basin.first > 0 && floor[basin.first - 1] < level_mm)
        --basin.first;
    while (basin.last + 1 < floor.size() && floor[basin.last + 1] < level_mm)
        ++basin.last;
    for (std::size_t m = basin.first; m <= basin.last; ++m)
        basin.volume += level_mm - floor[m];
    return basin;
}

/// The lowest points of the floor, no other one within 20 mm.
std::vector<std::size_t> lowPoints(const std::vector<double>& floor)
{
    constexpr std::size_t kReach = 20;
    std::vector<std::size_t> low;
    for (std::size_t n = 0; n < floor.size(); ++n) {
        const std::size_t from = n < kReach ? 0 : n - kReach, to = std::min(floor.size() - 1, n + kReach);
        const auto least = std::min_element(floor.begin() + long(from), floor.begin() + long(to) + 1);
        if (floor[n] < 1e8 && std::size_t(least - floor.begin()) == n)
            low.push_back(n);
    }
    return low;
}

}  // namespace

std::vector<FluidPool> drawPools(std::uint64_t seed, const Course& course, const Wall& wall, Position position)
{
    Random random(seed, "pools", std::uint64_t(position));
    const std::vector<double> floor = floorHeights(course, wall, -gravityOf(position));
    std::vector<Basin> basins;
    for (const std::size_t n : lowPoints(floor)) {
        const double wanted_mm = random.uniform(kShallowest_mm, kDeepest_mm);
        const double room_mm = std::min(spillHeight(floor, n, -1), spillHeight(floor, n, 1)) - floor[n] - 1;
        if (room_mm > kShallowest_mm / 2)
            basins.push_back(basinAround(floor, n, floor[n] + std::min(wanted_mm, room_mm)));
    }
    std::stable_sort(basins.begin(), basins.end(), [](const Basin& a, const Basin& b) { return a.volume > b.volume; });
    std::vector<Basin> kept;
    for (const Basin& basin : basins) {
        const bool free = std::none_of(kept.begin(), kept.end(), [&](const Basin& other) {
            return basin.first <= other.last + 3 && other.first <= basin.last + 3;
        });
        if (free && int(kept.size()) < kMostPools)
            kept.push_back(basin);
    }
    std::sort(kept.begin(), kept.end(), [](const Basin& a, const Basin& b) { return a.first < b.first; });
    std::vector<FluidPool> pools;
    for (const Basin& basin : kept)
        pools.push_back({course.stationOf(basin.first), course.stationOf(basin.last), basin.level_mm,
                         random.uniform(kFaintest_hu, kDensest_hu)});
    return pools;
}

}  // namespace vicon::phantom

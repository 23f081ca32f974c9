#include "bubbles.h"

#include <algorithm>
#include <numbers>

#include "random.h"

namespace vicon::phantom {
namespace {

constexpr double kSmallestBubble_mm = 2, kWidestBubble_mm = 6;
constexpr double kDeepestBubble_mm = 5;  // of a bubble's middle below the level: foam rises

/// A bubble anywhere in the lumen beside a station; its diameter is 0 where it does not lie in the pool.
GasBubble drawBubble(Random& random, const Course& course, const Wall& wall, const FluidPool& pool, Vector3 up)
{
    const double station_mm = random.uniform(pool.from_mm, pool.to_mm);
    const double angle = random.uniform(0, 2 * std::numbers::pi), share = random.uniform();
    const double diameter_mm = random.uniform(kSmallestBubble_mm, kWidestBubble_mm);
    const CourseSample& at = course.samples[course.sampleAt(station_mm)];
    const double room_mm = wall.at(station_mm, angle).lumen_mm - diameter_mm / 2;
    const Point3 p = at.position_mm +
                     (at.normal * std::cos(angle) + at.binormal * std::sin(angle)) * (share * std::max(0.0, room_mm));
    const double below_mm = pool.level_mm - dot(p - Point3{}, up);
    return {p, room_mm > 0 && below_mm > 0 && below_mm < kDeepestBubble_mm ? diameter_mm : 0};
}

}  // namespace

std::vector<GasBubble> drawBubbles(const PhantomOptions& options, const Course& course, const Wall& wall,
                                   const std::vector<FluidPool>& pools, Position position)
{
    constexpr int kTries = 200;  // a bubble
    std::vector<GasBubble> bubbles;
    if (pools.empty())
        return bubbles;
    Random random(options.seed, "bubbles", std::uint64_t(position));
    for (int tries = 0; tries < kTries * options.protocol.bubbles && int(bubbles.size()) < options.protocol.bubbles;
         ++tries) {
        const FluidPool& pool = pools[std::size_t(random.below(int(pools.size())))];
        if (const GasBubble one = drawBubble(random, course, wall, pool, -gravityOf(position)); one.diameter_mm > 0)
            bubbles.push_back(one);
    }
    return bubbles;
}

}  // namespace vicon::phantom

#include "segment/cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "grid/neighbours.h"
#include "grid/voxel_box.h"
#include "segment/points.h"
#include "vicon/core/nearest_voxel.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// No case recorded; reasons stand beside them. They act on a person's cuts alone.
constexpr double kReach_mm = 45;        // no colon is wider
constexpr double kHalfGap_mm = 1.5;     // half of what is cut out, so that its sides do not touch
constexpr int kDirections = 200;        // some 10 degrees apart: an area is at most 2 % too large
constexpr double kTowardsMiddle = 0.5;  // the wall distance grows by about 1 a mm towards the middle, by less along it

/// The lumen as far as a cut may reach.
InsideVolume blockAround(const InsideVolume& labels, Point3 point)
{
    const Index3 middle = labels.grid.indexAt(point);
    const auto& [sx, sy, sz] = labels.grid.spacing_mm;
    const Index3 reach{int(kReach_mm / sx) + 2, int(kReach_mm / sy) + 2, int(kReach_mm / sz) + 2};
    const Index3 lower{middle.i - reach.i, middle.j - reach.j, middle.k - reach.k};
    const Index3 end{middle.i + reach.i + 1, middle.j + reach.j + 1, middle.k + reach.k + 1};
    const Grid grid = cropped(labels.grid, {lower, end});
    auto block = makeVolume<std::uint8_t>(grid);
    for (std::size_t n = 0; n < block.voxels.size(); ++n)
        block.voxels[n] = labels.valueOr(shifted(lower, grid.indexOf(n)), kOutside);
    return block;
}

/// Away from the wall until the middle is reached, but not on along it.
Index3 middleBeside(const InsideVolume& block, Index3 start, Progress& progress)
{
    const FieldVolume wall_mm = wallDistance(block, progress);
    for (Index3 at = start;;) {
        Index3 best = at;
        double steepest = kTowardsMiddle;
        forEachInCube(at, 1, [&](Index3 next) {
            if (next == at || !block.grid.contains(next))
                return;
            const double step_mm = distance(block.grid.pointAt(next), block.grid.pointAt(at));
            if (const double slope = (wall_mm.at(next) - wall_mm.at(at)) / step_mm; slope > steepest) {
                steepest = slope;
                best = next;
            }
        });
        if (best == at)
            return at;
        at = best;
    }
}

/// How many samples of a plane hang together with its middle inside the lumen; as soon as they are `enough`, that.
int sectionAcross(const InsideVolume& block, Point3 middle, Vector3 normal, int enough)
{
    const double step_mm = *std::min_element(block.grid.spacing_mm.begin(), block.grid.spacing_mm.end());
    const Vector3 aside = std::abs(normal.x) < 0.8 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    const Vector3 u = normalized(cross(normal, aside)), v = cross(normal, u);
    const int reach = int(kReach_mm / step_mm), side = 2 * reach + 1;
    std::vector<bool> seen(std::size_t(side) * std::size_t(side));
    std::vector<std::pair<int, int>> front;
    const auto visit = [&](int a, int b) {
        if (std::hypot(a, b) > reach || seen[std::size_t(b + reach) * std::size_t(side) + std::size_t(a + reach)])
            return;
        seen[std::size_t(b + reach) * std::size_t(side) + std::size_t(a + reach)] = true;
        if (block.valueOr(block.grid.indexAt(middle + u * (a * step_mm) + v * (b * step_mm)), kOutside) != kOutside)
            front.emplace_back(a, b);
    };
    visit(0, 0);
    int count = 0;
    for (; !front.empty() && count < enough; ++count) {
        const auto [a, b] = front.back();
        front.pop_back();
        for (const auto& [da, db] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
            visit(a + da, b + db);
    }
    return count;
}

/// Directions spread evenly over half a sphere, as on a sunflower.
Vector3 direction(int n)
{
    const double z = (n + 0.5) / kDirections, around = n * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(around), r * std::sin(around), z};
}

Vector3 smallestSection(const InsideVolume& block, Point3 middle)
{
    Vector3 best;
    int least = int(block.voxels.size());
    for (int n = 0; n < kDirections; ++n)
        if (const int count = sectionAcross(block, middle, direction(n), least); count < least) {
            least = count;
            best = direction(n);
        }
    return best;
}

}  // namespace

std::vector<Index3> cutAcross(InsideVolume& labels, Point3 point, Progress& progress)
{
    const InsideVolume block = blockAround(labels, point);
    const auto start = nearestVoxel(block.grid, point, kCatch_mm, [&](Index3 v) { return block.at(v) != kOutside; });
    if (!start)
        return {};
    const Point3 middle = block.grid.pointAt(middleBeside(block, start->voxel, progress));
    const Vector3 normal = smallestSection(block, middle);
    const auto& spacing = labels.grid.spacing_mm;
    const double half_mm = std::max(kHalfGap_mm, *std::max_element(spacing.begin(), spacing.end()));
    std::vector<Index3> front{labels.grid.indexAt(middle)}, around;
    labels.at(front.front()) = kOutside;
    while (!front.empty()) {
        const Index3 at = front.back();
        front.pop_back();
        for (const Index3 face : kFaces) {
            const Index3 next = shifted(at, face);
            if (labels.valueOr(next, kOutside) == kOutside)
                continue;
            const Vector3 off = labels.grid.pointAt(next) - middle;
            if (std::abs(dot(off, normal)) > half_mm || length(off) > kReach_mm) {
                around.push_back(next);
                continue;
            }
            labels.at(next) = kOutside;
            front.push_back(next);
        }
    }
    return around;
}

}  // namespace vicon::steps

#include "segment/pieces/bridge_way.h"

#include <algorithm>
#include <cmath>

#include "grid/cheapest_ways.h"
#include "grid/neighbours.h"
#include "segment/constants.h"
#include "segment/pieces/cord_middle.h"
#include "skeleton/smooth.h"
#include "vicon/core/nearest_voxel.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// Of the way through a collapsed part. No case recorded but where one is named; of the costs the order matters. Half
// and double of each move the centreline of the three cases (CONTRIBUTING.md) by at most 10 mm, inside the bridges.
constexpr double kCell_mm = 1.5;      // of the grid on which the way is sought: averages out noise
constexpr double kMargin_mm = 25;     // of that grid around the two tips
constexpr double kReach_mm = 40;      // lumen farther from the tips is no part of the way
constexpr double kCordRadius_mm = 8;  // no collapsed bowel is thicker: larger organs are no better than it
constexpr double kCostWithoutCord =
    64;  // per millimetre; soft tissue of 8 mm and more costs 1: fat is crossed only in need
constexpr double kBarredCost = 256;  // bone, air
// Of a way in the lumen that is to be left: it may be left anywhere, but not for a neighbour through thin walls. With 1
// a tip beside the body's wall is joined along that wall's muscle (phantom 247, by up to 30 mm aside of the bowel).
constexpr double kLumenShare = 0.5;
// At no more than this share of soft tissue no cord is seen, and the way says only where it leaves and enters. Second
// phantom 310, whose gaps hold fat alone: followed all the same, the curve was 8 mm off.
constexpr double kCordSeen = 0.5;
constexpr double kSmoothing_mm = 3;   // of the chain of voxels
constexpr std::ptrdiff_t kLead = 15;  // mm of the chain in the lumen on either side, centred with what joins them

enum CordVoxel : std::uint8_t { kFat = 0, kSoft = 1, kBarred = 2, kBefore = 3, kAfter = 4 };

struct Cord {
    Grid grid;
    std::vector<std::uint8_t> cells;
    FieldVolume depth_mm;  ///< of soft tissue and lumen together
};

/// A coarser grid around both tips, axes as the scan's.
Grid gridAround(const Grid& scan, Point3 a, Point3 b)
{
    Grid grid = scan;
    const ContinuousIndex3 ca = scan.continuousIndexAt(a), cb = scan.continuousIndexAt(b);
    const double from[3] = {std::min(ca.i, cb.i), std::min(ca.j, cb.j), std::min(ca.k, cb.k)};
    const double to[3] = {std::max(ca.i, cb.i), std::max(ca.j, cb.j), std::max(ca.k, cb.k)};
    int first[3];
    for (std::size_t n = 0; n < 3; ++n) {
        const double margin = kMargin_mm / scan.spacing_mm[n];
        const int factor = std::max(1, int(std::lround(kCell_mm / scan.spacing_mm[n])));
        first[n] = std::clamp(int(from[n] - margin), 0, scan.size[n] - 1);
        const int last = std::clamp(int(to[n] + margin), first[n], scan.size[n] - 1);
        grid.size[n] = std::max(1, (last - first[n] + 1) / factor);
        grid.spacing_mm[n] = scan.spacing_mm[n] * factor;
    }
    const double half = 0.5;
    const auto centre = [&](std::size_t n) { return first[n] + half * (grid.spacing_mm[n] / scan.spacing_mm[n] - 1); };
    grid.origin_mm = scan.pointAt(ContinuousIndex3{centre(0), centre(1), centre(2)});
    return grid;
}

/// Mean density of the voxels of the scan in a cell.
double meanIn(const HuVolume& volume, const Grid& grid, Index3 cell)
{
    const ContinuousIndex3 c = volume.grid.continuousIndexAt(grid.pointAt(cell));
    int factor[3];
    for (std::size_t n = 0; n < 3; ++n)
        factor[n] = int(std::lround(grid.spacing_mm[n] / volume.grid.spacing_mm[n]));
    const auto first = [](double middle, int count) { return int(std::lround(middle - 0.5 * (count - 1))); };
    const Index3 v{first(c.i, factor[0]), first(c.j, factor[1]), first(c.k, factor[2])};
    double sum = 0;
    for (int k = 0; k < factor[2]; ++k)
        for (int j = 0; j < factor[1]; ++j)
            for (int i = 0; i < factor[0]; ++i)
                sum += volume.valueOr({v.i + i, v.j + j, v.k + k}, std::int16_t(kAir_hu));
    return sum / (factor[0] * factor[1] * factor[2]);
}

/// The lumen about a tip: connected, and near enough to it to lead into the collapsed part.
void markLumen(Cord& cord, const std::vector<std::uint8_t>& lumen, Point3 tip, CordVoxel as)
{
    const Grid& grid = cord.grid;
    const auto nearest = nearestVoxel(grid, tip, kAnyDistance_mm, [&](Index3 v) { return lumen[grid.offset(v)] != 0; });
    if (!nearest)
        return;
    const auto take = [&](std::size_t n) {
        if (!lumen[n] || cord.cells[n] == kBefore || cord.cells[n] == kAfter ||
            distance(grid.pointAt(grid.indexOf(n)), tip) > kReach_mm)
            return false;
        cord.cells[n] = as;
        return true;
    };
    cord.cells[grid.offset(nearest->voxel)] = as;
    floodOverFaces(grid, {grid.offset(nearest->voxel)}, take);
}

Cord cordBetween(const HuVolume& volume, const InsideVolume& inside, const WallDensities& densities, Point3 from,
                 Point3 to, Progress& progress)
{
    Cord cord;
    cord.grid = gridAround(volume.grid, from, to);
    cord.cells.assign(cord.grid.voxelCount(), kFat);
    std::vector<std::uint8_t> lumen(cord.cells.size(), 0);
    for (std::size_t n = 0; n < cord.cells.size(); ++n) {
        const Index3 v = cord.grid.indexOf(n);
        lumen[n] = inside.valueOr(inside.grid.indexAt(cord.grid.pointAt(v)), 0) ? 1 : 0;
        const double hu = meanIn(volume, cord.grid, v);
        const bool barred = lumen[n] || hu < kBody_hu || hu > kBone_hu;
        cord.cells[n] = barred ? kBarred : hu > softFrom_hu(densities) ? kSoft : kFat;
    }
    progress.check();
    markLumen(cord, lumen, from, kBefore);
    markLumen(cord, lumen, to, kAfter);
    InsideVolume mask(cord.grid);
    for (std::size_t n = 0; n < cord.cells.size(); ++n)
        mask.voxels[n] = cord.cells[n] == kFat || cord.cells[n] == kBarred ? kOutside : kGas;
    cord.depth_mm = wallDistance(mask, progress);
    return cord;
}

double costOf(const Cord& cord, std::size_t n)
{
    if (cord.cells[n] == kBarred)
        return kBarredCost;
    const double depth = std::min(double(cord.depth_mm.voxels[n]), kCordRadius_mm);
    const double share = cord.cells[n] == kSoft ? 1 : kLumenShare;
    return depth > 0 ? share * std::min(kCostWithoutCord, std::pow(kCordRadius_mm / depth, 2)) : kCostWithoutCord;
}

/// The cheapest chain of cells between two points.
std::vector<std::size_t> cheapest(const Cord& cord, Point3 from, Point3 to, Progress& progress)
{
    const Grid& grid = cord.grid;
    const auto cellAt = [&](Point3 p) {
        const Index3 v = grid.indexAt(p);
        return grid.offset({std::clamp(v.i, 0, grid.size[0] - 1), std::clamp(v.j, 0, grid.size[1] - 1),
                            std::clamp(v.k, 0, grid.size[2] - 1)});
    };
    const std::size_t start = cellAt(from), goal = cellAt(to);
    CheapestWays<CheapestFirstWide> ways(cord.cells.size(), start);
    std::size_t count = 0;
    const auto isGoal = [&](std::uint32_t n, double) {
        if (++count % 4096 == 0)
            progress.check();
        return n == goal;
    };
    ways.run(isGoal, [&](std::uint32_t n, auto offer) {
        const Index3 v = grid.indexOf(n);
        forEachInCube(v, 1, [&](Index3 w) {
            if (w == v || !grid.contains(w))
                return;
            const std::size_t m = grid.offset(w);
            offer(m, distance(grid.pointAt(v), grid.pointAt(w)) * 0.5 * (costOf(cord, n) + costOf(cord, m)));
        });
    });
    return ways.wayTo(goal);
}

/// The cells of the chain that lie between the two lumens, with one of each.
struct Stretch {
    std::size_t first = 0, last = 0;
    std::size_t soft = 0;  ///< how many of them are soft tissue or lumen
};

Stretch betweenLumens(const Cord& cord, const std::vector<std::size_t>& chain)
{
    Stretch s{0, chain.size() - 1};
    for (std::size_t n = 0; n < chain.size(); ++n)
        if (cord.cells[chain[n]] == kBefore)
            s.first = n;
    for (std::size_t n = chain.size(); n-- > s.first;)
        if (cord.cells[chain[n]] == kAfter)
            s.last = n;
    for (std::size_t n = s.first; n <= s.last; ++n)
        s.soft += cord.cells[chain[n]] == kFat || cord.cells[chain[n]] == kBarred ? 0 : 1;
    return s;
}

/// The stretch of the chain between the two lumens, and the share of it in soft tissue.
struct Crossing {
    std::vector<Point3> path_mm;
    double soft_share = 0;
};

/// The longest stretch of the line outside the lumen, with the last points inside on both sides.
Polyline outsideLumen(const Polyline& line, const InsideVolume& inside)
{
    const auto in = [&](Point3 p) { return inside.valueOr(inside.grid.indexAt(p), kOutside) != kOutside; };
    auto best = line.begin(), best_end = line.begin();
    for (auto from = line.begin(); from != line.end();) {
        from = std::find_if_not(from, line.end(), in);
        const auto to = std::find_if(from, line.end(), in);
        // A stretch that touches an end of the line lies between no two lumens.
        if (from != line.begin() && to != line.end() && to - from > best_end - best) {
            best = from;
            best_end = to;
        }
        from = to;
    }
    return best == best_end ? Polyline{} : Polyline{best - 1, best_end + 1};
}

Crossing crossing(const Cord& cord, const std::vector<std::size_t>& chain, const HuVolume& volume,
                  const InsideVolume& inside, const WallDensities& densities, Progress& progress)
{
    const auto [first, last, soft] = betweenLumens(cord, chain);
    std::vector<Point3> line;
    line.reserve(chain.size());
    for (const std::size_t n : chain)
        line.push_back(cord.grid.pointAt(cord.grid.indexOf(n)));
    // Smoothed with what lies in the lumen on both sides, so that the ends keep their direction; then cut.
    const Point3 leave = line[first], enter = line[last];
    const Polyline smooth = smoothed(resampled(line, 1), kSmoothing_mm, 1);
    const auto near = [&](Point3 p) {
        return std::min_element(smooth.begin(), smooth.end(),
                                [&](Point3 a, Point3 b) { return distance(a, p) < distance(b, p); });
    };
    auto begin = near(leave), end = near(enter);
    if (begin > end)
        std::swap(begin, end);
    const auto lead = std::min(kLead, begin - smooth.begin()), tail = std::min(kLead, smooth.end() - 1 - end);
    const double share = double(soft) / double(last - first + 1);
    const Polyline centred = middleOfCord(volume, inside, densities, {begin - lead, end + tail + 1}, progress);
    if (Polyline way = outsideLumen(centred, inside); way.size() > 1)
        return {std::move(way), share};
    Crossing out{{begin, end + 1}, share};
    if (out.path_mm.size() < 2)
        out.path_mm = {leave, enter};
    return out;
}

}  // namespace

void judgeBridge(Bridge& bridge, double soft_share, double longest_sure_mm)
{
    bridge.confidence = std::clamp(soft_share, 0.2, 1.0) * std::exp(-bridge.length_mm / (2 * longest_sure_mm));
    bridge.certain = bridge.length_mm <= longest_sure_mm && soft_share > kCordSeen;
    bridge.reason = bridge.length_mm > longest_sure_mm ? "the gap is long"
                    : soft_share <= kCordSeen          ? "the way between the pieces leads through fat"
                                                       : "a short gap through soft tissue";
}

double fatBetween_mm(const HuVolume& volume, const InsideVolume& inside, const WallDensities& densities, Point3 from,
                     Point3 to, Progress& progress)
{
    const Cord cord = cordBetween(volume, inside, densities, from, to, progress);
    const std::vector<std::size_t> chain = cheapest(cord, from, to, progress);
    const Stretch stretch = betweenLumens(cord, chain);
    double fat_mm = 0;
    const auto fat = [&](std::size_t n) { return cord.cells[n] == kFat || cord.cells[n] == kBarred ? 0.5 : 0.0; };
    for (std::size_t n = stretch.first + 1; n <= stretch.last; ++n) {
        const std::size_t a = chain[n - 1], b = chain[n];
        fat_mm += (fat(a) + fat(b)) *
                  distance(cord.grid.pointAt(cord.grid.indexOf(a)), cord.grid.pointAt(cord.grid.indexOf(b)));
    }
    return fat_mm;
}

void followCords(const HuVolume& volume, const InsideVolume& inside, const SegmentOptions& options, LumenPlan& plan,
                 Progress& progress)
{
    for (Bridge& bridge : plan.bridges) {
        const Cord cord = cordBetween(volume, inside, options.densities, bridge.from_mm, bridge.to_mm, progress);
        const Crossing way = crossing(cord, cheapest(cord, bridge.from_mm, bridge.to_mm, progress), volume, inside,
                                      options.densities, progress);
        bridge.path_mm = way.path_mm;
        if (way.soft_share <= kCordSeen)
            bridge.path_mm = {way.path_mm.front(), way.path_mm.back()};
        bridge.from_mm = way.path_mm.front();
        bridge.to_mm = way.path_mm.back();
        bridge.length_mm = 0;
        for (std::size_t n = 1; n < bridge.path_mm.size(); ++n)
            bridge.length_mm += distance(bridge.path_mm[n - 1], bridge.path_mm[n]);
        judgeBridge(bridge, way.soft_share, options.longest_sure_bridge_mm);
    }
}

}  // namespace vicon::steps

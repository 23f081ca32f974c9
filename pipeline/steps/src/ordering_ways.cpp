#include "ordering_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace vicon::steps {
namespace {

constexpr double kBoneHu = 250;   // mean of a coarse voxel that holds no lumen
constexpr double kFatHu = -30;    // below: fat around the bowel, not its wall
constexpr double kLungHu = -400;  // below, and not lumen: lung, or gas that is no bowel
constexpr float kLumenCost = 0.8F, kTissueCost = 1, kFatCost = 2, kGasCost = 4;
constexpr double kHorizon = 150;  // beyond, a way is not looked for but guessed as straight
constexpr double kGuess = 2;      // cost per millimetre of a guessed way

/// What a straight way costs; infinite where it cannot be gone.
double straightCost(const Volume<float>& costs, Point3 a, Point3 b)
{
    const double length_mm = distance(a, b);
    const int steps = std::max(1, int(std::ceil(length_mm / (costs.grid.spacing_mm[0] / 2))));
    double sum = 0;
    for (int n = 0; n <= steps; ++n) {
        const float here = costs.valueOr(costs.grid.indexAt(interpolate(a, b, double(n) / steps)), 0);
        if (here <= 0)
            return std::numeric_limits<double>::infinity();
        sum += here;
    }
    return sum / (steps + 1) * length_mm;
}

/// A chain of voxels goes in steps of 45 degrees: replaces stretches of it by straight lines that cost no more.
std::vector<Point3> pulledStraight(const Volume<float>& costs, const std::vector<Point3>& path)
{
    std::vector<Point3> out{path.front()};
    for (std::size_t from = 0; from + 1 < path.size();) {
        std::size_t to = from + 1;
        double along = straightCost(costs, path[from], path[to]);
        for (std::size_t n = from + 2; n < path.size(); ++n) {
            along += straightCost(costs, path[n - 1], path[n]);
            if (straightCost(costs, path[from], path[n]) <= along)
                to = n;
        }
        out.push_back(path[to]);
        from = to;
    }
    return out;
}

}  // namespace

Volume<float> tissueCosts(const Body& body, const InsideVolume& labels)
{
    Volume<float> costs(body.inside.grid, 0);
    std::vector<std::uint8_t> lumen(costs.voxels.size(), 0);
    for (int k = 0; k < labels.grid.size[2]; ++k)
        for (int j = 0; j < labels.grid.size[1]; ++j) {
            const std::uint8_t* row = &labels.voxels[labels.grid.offset({0, j, k})];
            std::uint8_t* out = &lumen[costs.grid.offset({0, j / body.factor, k / body.factor})];
            for (int i = 0; i < labels.grid.size[0]; ++i)
                if (row[i])
                    out[i / body.factor] = 1;
        }
    for (std::size_t n = 0; n < costs.voxels.size(); ++n) {
        const double hu = body.mean_hu.voxels[n];
        if (lumen[n])
            costs.voxels[n] = kLumenCost;
        else if (!body.inside.voxels[n] || hu > kBoneHu)
            costs.voxels[n] = 0;
        else
            costs.voxels[n] = hu < kLungHu ? kGasCost : hu < kFatHu ? kFatCost : kTissueCost;
    }
    return costs;
}

std::vector<TissueWay> waysFrom(const Volume<float>& costs, Point3 from, const std::vector<Point3>& to,
                                Progress& progress)
{
    const Grid& grid = costs.grid;
    const auto clamped = [&](Point3 p) {
        const Index3 v = grid.indexAt(p);
        return Index3{std::clamp(v.i, 0, grid.size[0] - 1), std::clamp(v.j, 0, grid.size[1] - 1),
                      std::clamp(v.k, 0, grid.size[2] - 1)};
    };
    std::vector<float> cost(costs.voxels.size(), std::numeric_limits<float>::infinity());
    std::vector<std::int32_t> parent(costs.voxels.size(), -1);
    std::priority_queue<std::pair<float, std::size_t>, std::vector<std::pair<float, std::size_t>>, std::greater<>>
        queue;
    const std::size_t start = grid.offset(clamped(from));
    cost[start] = 0;
    queue.push({0, start});
    std::vector<std::size_t> goals;
    for (const Point3 p : to)
        goals.push_back(grid.offset(clamped(p)));
    for (std::size_t count = 0; !queue.empty(); ++count) {
        if (count % 65536 == 0)
            progress.check();
        const auto [so_far, n] = queue.top();
        queue.pop();
        if (so_far > cost[n])
            continue;
        if (so_far > kHorizon)
            break;
        const Index3 v = grid.indexOf(n);
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const Index3 w{v.i + i, v.j + j, v.k + k};
                    if ((!i && !j && !k) || !grid.contains(w))
                        continue;
                    const std::size_t m = grid.offset(w);
                    if (costs.voxels[m] <= 0 || cost[m] <= so_far)
                        continue;
                    const auto step = float(std::sqrt(double(i * i + j * j + k * k)) * grid.spacing_mm[0]);
                    const float reached = so_far + step * 0.5F * (std::max(costs.voxels[n], 0.1F) + costs.voxels[m]);
                    if (reached < cost[m]) {
                        cost[m] = reached;
                        parent[m] = std::int32_t(n);
                        queue.push({reached, m});
                    }
                }
    }
    std::vector<TissueWay> ways(to.size());
    for (std::size_t g = 0; g < goals.size(); ++g) {
        if (cost[goals[g]] > kHorizon) {
            ways[g] = {std::max(kHorizon, kGuess * distance(from, to[g])), {from, to[g]}};
            continue;
        }
        ways[g].cost = cost[goals[g]];
        for (auto n = std::int32_t(goals[g]); n >= 0; n = parent[std::size_t(n)])
            ways[g].path_mm.push_back(grid.pointAt(grid.indexOf(std::size_t(n))));
        std::reverse(ways[g].path_mm.begin(), ways[g].path_mm.end());
        ways[g].path_mm.front() = from;
        ways[g].path_mm.back() = to[g];
        ways[g].path_mm = pulledStraight(costs, ways[g].path_mm);
    }
    return ways;
}

}  // namespace vicon::steps

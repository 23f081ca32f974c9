#include "segment/pieces/tissue_ways.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "grid/cheapest_ways.h"
#include "grid/neighbours.h"
#include "segment/constants.h"

namespace vicon::steps {
namespace {

// Costs are in mm of soft tissue. No case recorded; reason: a collapsed colon is soft tissue; fat beside it costs
// twice, and gas outside the pieces twice that. The order that comes out is held by chain_family_test, on seeds that
// nothing was chosen on; half and double of each leave the three cases (CONTRIBUTING.md) as they are.
constexpr float kLumenCost = 0.8F, kTissueCost = 1, kFatCost = 2, kGasCost = 4;  // of a millimetre
constexpr double kLeastCost = 0.75;  // of a way's millimetre: a start that is closed itself shortens the first step
constexpr double kHorizon = 150;     // beyond, a way is not looked for but guessed as straight
constexpr double kGuess = 2;         // of a guessed way's millimetre: as of fat

/// To one of the 26 voxels around.
struct Step {
    Index3 by;
    std::ptrdiff_t offset;
    float length_mm;
};

std::vector<Step> stepsOf(const Grid& grid)
{
    const std::ptrdiff_t row = grid.size[0], slice = row * grid.size[1];
    std::vector<Step> steps;
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                if (i || j || k)
                    steps.push_back({{i, j, k},
                                     i + j * row + k * slice,
                                     float(std::sqrt(double(i * i + j * j + k * k)) * grid.spacing_mm[0])});
    return steps;
}

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

/// The nearest voxel of the grid.
std::size_t voxelAt(const Grid& grid, Point3 p)
{
    const Index3 v = grid.indexAt(p);
    return grid.offset({std::clamp(v.i, 0, grid.size[0] - 1), std::clamp(v.j, 0, grid.size[1] - 1),
                        std::clamp(v.k, 0, grid.size[2] - 1)});
}

using Ways = CheapestWays<CheapestFirst>;

/// Goes out from a voxel until all of some goals are reached, or the horizon.
Ways searchFrom(const Volume<float>& costs, std::size_t start, std::set<std::size_t> goals, Progress& progress)
{
    const Grid& grid = costs.grid;
    const std::vector<Step> steps = stepsOf(grid);
    Ways reached(costs.voxels.size(), start);
    std::size_t count = 0;
    const auto isOver = [&](std::uint32_t n, float so_far) {
        if (count++ % 65536 == 0)
            progress.check();
        return so_far > kHorizon || (goals.erase(n) > 0 && goals.empty());
    };
    reached.run(isOver, [&](std::uint32_t n, auto offer) {
        const Index3 v = grid.indexOf(n);
        const bool within =
            v.i > 0 && v.j > 0 && v.k > 0 && v.i + 1 < grid.size[0] && v.j + 1 < grid.size[1] && v.k + 1 < grid.size[2];
        for (const Step& step : steps) {
            if (!within && !grid.contains(shifted(v, step.by)))
                continue;
            const std::size_t m = std::size_t(std::ptrdiff_t(n) + step.offset);
            if (costs.voxels[m] > 0)
                offer(m, step.length_mm * 0.5F * (std::max(costs.voxels[n], 0.1F) + costs.voxels[m]));
        }
    });
    return reached;
}

/// The way that was found to a voxel, or a guess where none was.
TissueWay wayBetween(const Volume<float>& costs, const Ways& reached, Point3 from, Point3 to, std::size_t goal)
{
    if (reached.costOf(goal) > kHorizon)
        return {std::max(kHorizon, kGuess * distance(from, to)), {from, to}};
    TissueWay way{reached.costOf(goal), {}};
    for (const std::size_t n : reached.wayTo(goal))
        way.path_mm.push_back(costs.grid.pointAt(costs.grid.indexOf(n)));
    way.path_mm.front() = from;
    way.path_mm.back() = to;
    way.path_mm = pulledStraight(costs, way.path_mm);
    return way;
}

}  // namespace

Volume<float> tissueCosts(const Body& body, const InsideVolume& labels, const WallDensities& densities)
{
    Volume<float> costs(body.inside.grid, 0);
    std::vector<std::uint8_t> lumen(costs.voxels.size(), 0);
    const auto [nx, ny, nz] = labels.grid.size;
    tbb::parallel_for(0, costs.grid.size[2], [&, nx = nx, ny = ny, nz = nz, factor = body.factor](int ck) {
        for (int k = ck * factor; k < std::min(nz, (ck + 1) * factor); ++k)
            for (int j = 0; j < ny; ++j) {
                const std::uint8_t* row = &labels.voxels[labels.grid.offset({0, j, k})];
                std::uint8_t* out = &lumen[costs.grid.offset({0, j / factor, ck})];
                for (int i = 0; i < nx; ++out)
                    for (const int end = std::min(nx, i + factor); i < end; ++i)
                        *out |= row[i];
            }
    });
    for (std::size_t n = 0; n < costs.voxels.size(); ++n) {
        const double hu = body.mean_hu.voxels[n];
        if (lumen[n])
            costs.voxels[n] = kLumenCost;
        else if (!body.inside.voxels[n] || hu > kBone_hu)
            costs.voxels[n] = 0;
        else
            costs.voxels[n] = hu < kBody_hu ? kGasCost : hu < softFrom_hu(densities) ? kFatCost : kTissueCost;
    }
    return costs;
}

std::vector<TissueWay> waysFrom(const Volume<float>& costs, Point3 from, const std::vector<Point3>& to,
                                Progress& progress)
{
    const Grid& grid = costs.grid;
    const std::size_t start = voxelAt(grid, from);
    std::vector<std::size_t> goals;
    std::set<std::size_t> near;  // those that may lie within the horizon: the search ends when all are reached
    for (const Point3 p : to) {
        goals.push_back(voxelAt(grid, p));
        if (kLeastCost * distance(grid.pointAt(grid.indexOf(start)), grid.pointAt(grid.indexOf(goals.back()))) <=
            kHorizon)
            near.insert(goals.back());
    }
    const Ways reached = searchFrom(costs, start, std::move(near), progress);
    std::vector<TissueWay> ways;
    for (std::size_t g = 0; g < goals.size(); ++g)
        ways.push_back(wayBetween(costs, reached, from, to[g], goals[g]));
    return ways;
}

}  // namespace vicon::steps

#include "segment/pieces/ordering.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "segment/pieces/tissue_ways.h"

namespace vicon::steps {
namespace {

// Costs of an order, in mm of soft tissue. No case recorded but for kPerMmOfFat; reason: each is the length of bridge
// against which it is weighed. The order that comes out is held by chain_family_test, on seeds that nothing was chosen
// on; half and double of each leave the three cases (CONTRIBUTING.md) as they are.
constexpr double kWrongEnd = 60;  // a last end that is not in the patient's right lower half, in mm of tissue
constexpr double kTurn = 15;      // a bridge that leaves a piece backwards
constexpr double kOneMore = 20;   // every further piece: none is added without need
constexpr double kNoWay = 1e8;
// A millimetre of a bridge through fat, bone or other gas, beside its length: a collapsed colon is a cord of soft
// tissue from lumen to lumen. Chosen on phantom 215.
constexpr double kPerMmOfFat = 4;

struct PieceWays {
    std::vector<std::vector<TissueWay>> from_tip;  // [2 * candidate + tip][2 * candidate + tip], where one is asked for
    std::vector<std::vector<bool>> judged;         // the same: whether the cost holds what the fat on the way costs
};

/// Ways from piece to piece; none leads into the rectum or out of its far end.
PieceWays allWays(const std::vector<Candidate>& candidates, std::size_t rectum, const Body& body,
                  const InsideVolume& labels, const WallDensities& densities, Progress& progress)
{
    const Volume<float> costs = tissueCosts(body, labels, densities);
    std::vector<Point3> tips;
    for (const Candidate& c : candidates)
        tips.insert(tips.end(), {c.tip_mm[0], c.tip_mm[1]});
    const std::size_t count = tips.size();
    PieceWays ways{std::vector(count, std::vector<TissueWay>(count)),
                   std::vector(count, std::vector<bool>(count, false))};
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t from) {
        std::vector<std::size_t> others;
        std::vector<Point3> to;
        for (std::size_t n = 0; n < count && from != 2 * rectum; ++n)
            if (n / 2 != from / 2 && n / 2 != rectum) {
                others.push_back(n);
                to.push_back(tips[n]);
            }
        if (others.empty())
            return;
        std::vector<TissueWay> found = waysFrom(costs, tips[from], to, progress);
        for (std::size_t n = 0; n < others.size(); ++n)
            ways.from_tip[from][others[n]] = std::move(found[n]);
    });
    return ways;
}

double endCost(Point3 end, const Body& body)
{
    const Point3 middle = interpolate(body.lower_mm, body.upper_mm, 0.5);
    return (end.x > middle.x ? kWrongEnd / 2 : 0) + (end.z > middle.z ? kWrongEnd / 2 : 0);
}

/// How much a bridge turns against the pieces that it joins.
double turnCost(const Candidate& a, int exit_tip, const Candidate& b, int entry_tip)
{
    const Vector3 bridge = normalized(b.tip_mm[entry_tip] - a.tip_mm[exit_tip]);
    const Vector3 leaving = normalized(a.tip_mm[exit_tip] - a.tip_mm[1 - exit_tip]);
    const Vector3 entering = normalized(b.tip_mm[1 - entry_tip] - b.tip_mm[entry_tip]);
    return kTurn * (std::max(0.0, -dot(bridge, leaving)) + std::max(0.0, -dot(bridge, entering)));
}

/// The best way to have visited a set of candidates and to stand at a tip of the last one.
struct State {
    double cost = std::numeric_limits<double>::infinity();
    int before = -1;  // tip number of the state before, within the set without this candidate
};

double omissionCost(const std::vector<Candidate>& candidates, unsigned set, const std::vector<int>& required)
{
    double cost = 0;
    for (std::size_t n = 0; n < candidates.size(); ++n)
        if (!(set >> n & 1U))
            cost += candidates[n].length_mm * candidates[n].colon_likeness;
    for (const int n : required)
        cost += set >> unsigned(n) & 1U ? 0 : kNoWay;
    return cost;
}

Bridge makeBridge(const TissueWay& way, double longest_sure_mm)
{
    Bridge bridge{way.path_mm.front(), way.path_mm.back(), way.path_mm};
    for (std::size_t n = 1; n < way.path_mm.size(); ++n)
        bridge.length_mm += distance(way.path_mm[n - 1], way.path_mm[n]);
    // Soft tissue all the way costs its length; fat, or gas that is no bowel, costs more and is less likely colon.
    const double through = bridge.length_mm > 0 ? std::clamp(1.5 - way.cost / bridge.length_mm / 2, 0.2, 1.0) : 1;
    bridge.confidence = through * std::exp(-bridge.length_mm / (2 * longest_sure_mm));
    bridge.certain = bridge.length_mm <= longest_sure_mm && through > 0.5;
    bridge.reason = bridge.length_mm > longest_sure_mm ? "the gap is long"
                    : through <= 0.5                   ? "the way between the pieces leads through fat"
                                                       : "a short gap through soft tissue";
    return bridge;
}

/// The tips through which the colon runs, from the rectal one: in and out of each piece.
using TipOrder = std::vector<std::size_t>;

TipOrder cheapestOrder(const std::vector<Candidate>& candidates, int rectum, const std::vector<int>& required,
                       const Body& body, const PieceWays& ways)
{
    const auto count = unsigned(candidates.size());
    // A state's tip is the one through which the piece is left: 2 * candidate + tip.
    std::vector<std::vector<State>> best(std::size_t(1) << count, std::vector<State>(2 * std::size_t(count)));
    best[1U << unsigned(rectum)][2 * std::size_t(rectum) + 1] = {0, -1};
    for (unsigned set = 1; set < best.size(); ++set)
        for (unsigned tip = 0; tip < 2 * count; ++tip) {
            const State& here = best[set][tip];
            if (!std::isfinite(here.cost))
                continue;
            for (unsigned next = 0; next < count; ++next)
                for (unsigned entry = 0; entry < 2 && !(set >> next & 1U); ++entry) {
                    const double cost = here.cost + kOneMore + ways.from_tip[tip][2 * next + entry].cost +
                                        turnCost(candidates[tip / 2], int(tip % 2), candidates[next], int(entry));
                    State& there = best[set | 1U << next][2 * next + 1 - entry];
                    if (cost < there.cost)
                        there = {cost, int(tip)};
                }
        }
    double least = std::numeric_limits<double>::infinity();
    unsigned last_set = 0, last_tip = 0;
    for (unsigned set = 1; set < best.size(); ++set)
        for (unsigned tip = 0; tip < 2 * count; ++tip) {
            const double cost = best[set][tip].cost + omissionCost(candidates, set, required) +
                                endCost(candidates[tip / 2].tip_mm[tip % 2], body);
            if (cost < least) {
                least = cost;
                last_set = set;
                last_tip = tip;
            }
        }
    TipOrder order;
    for (int tip = int(last_tip); tip >= 0;) {
        order.insert(order.end(), {std::size_t(tip), std::size_t(tip ^ 1)});
        const int before = best[last_set][std::size_t(tip)].before;
        last_set &= ~(1U << unsigned(tip / 2));
        tip = before;
    }
    std::reverse(order.begin(), order.end());
    return order;
}

/// Adds to each bridge of an order what the fat on it costs; false where nothing was left to add.
bool judgeBridges(const TipOrder& order, const FatBetween& fat_mm, PieceWays& ways)
{
    bool changed = false;
    for (std::size_t n = 1; n + 1 < order.size(); n += 2) {
        const std::size_t from = order[n], to = order[n + 1];
        if (ways.judged[from][to])
            continue;
        const TissueWay& way = ways.from_tip[from][to];
        const double cost = kPerMmOfFat * fat_mm(way.path_mm.front(), way.path_mm.back());
        ways.from_tip[from][to].cost += cost;
        ways.from_tip[to][from].cost += cost;
        ways.judged[from][to] = ways.judged[to][from] = true;
        changed = true;
    }
    return changed;
}

}  // namespace

Ordering orderPieces(const std::vector<Candidate>& candidates, int rectum, const std::vector<int>& required,
                     const Body& body, const InsideVolume& labels, const FatBetween& fat_mm,
                     const SegmentOptions& options, Progress& progress)
{
    Ordering ordering;
    const auto wide =
        std::count_if(candidates.begin(), candidates.end(), [](const Candidate& c) { return c.colon_likeness > 0; });
    if (required.empty() &&
        (candidates.size() == 1 || (wide == 1 && candidates[std::size_t(rectum)].colon_likeness > 0))) {
        ordering.pieces.push_back({rectum, false});
        return ordering;
    }
    PieceWays ways = allWays(candidates, std::size_t(rectum), body, labels, options.densities, progress);
    // To look closely at a way takes long and only adds to its cost: when all bridges of the cheapest order have been
    // looked at, no other order can be cheaper.
    TipOrder order = cheapestOrder(candidates, rectum, required, body, ways);
    while (judgeBridges(order, fat_mm, ways))
        order = cheapestOrder(candidates, rectum, required, body, ways);
    for (std::size_t n = 0; n < order.size(); n += 2) {
        ordering.pieces.push_back({int(order[n] / 2), order[n] % 2 == 1});
        if (n > 0)
            ordering.bridges.push_back(
                makeBridge(ways.from_tip[order[n - 1]][order[n]], options.longest_sure_bridge_mm));
    }
    return ordering;
}

}  // namespace vicon::steps

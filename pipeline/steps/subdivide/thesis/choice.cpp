#include "subdivide/thesis/choice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>

namespace vicon::steps {
namespace {

/// Segments of these parts of the target are considered. No case recorded: the limits are not met.
constexpr double kSmallestChosen = 0.25, kLargestChosen = 4;
constexpr double kNotGood = 1;  // what a portal costs more that does not meet its criterion
constexpr auto kNone = std::numeric_limits<std::size_t>::max();

std::vector<CutPlane> allPlanes(const PlanesAt& planes, std::size_t voxels)
{
    std::vector<std::vector<CutPlane>> at(voxels);
    tbb::parallel_for(std::size_t(1), voxels - 1, [&](std::size_t n) { at[n] = planes(n); });
    std::vector<CutPlane> all;
    for (auto& some : at)
        std::move(some.begin(), some.end(), std::back_inserter(all));
    return all;
}

/// Numbers of planes, in order of the path, and what they cost.
struct Chain {
    std::vector<std::size_t> planes;
    double cost = 0;
};

class Choice {
public:
    Choice(const std::vector<CutPlane>& all, const PathSizes& sizes, Progress& progress)
        : all_(all), sizes_(sizes), progress_(progress)
    {
    }

    PortalChoice choose(int most_solved)
    {
        std::priority_queue<Open> open;
        const auto add = [&](std::vector<bool> barred) {
            Chain chain = solve(barred);
            open.push({std::move(chain), std::move(barred)});
        };
        add(std::vector<bool>(all_.size(), false));
        Chain best = withoutCrossings(open.top().chain);
        PortalChoice choice{.planes = {}, .cost = 0, .at_least = 0, .neighbours_only = best.cost};
        for (int solved = 1; !open.empty() && open.top().chain.cost < best.cost && solved < most_solved; solved += 2) {
            progress_.check();
            const Open next = open.top();
            open.pop();
            const std::optional<std::size_t> meets = firstThatMeets(next.chain);
            if (!meets) {
                best = next.chain;
                break;
            }
            std::vector<bool> without = next.barred, with = next.barred;
            without[*meets] = true;
            for (std::size_t n = 0; n < all_.size(); ++n)
                with[n] = with[n] || (n != *meets && cross(n, *meets));
            add(std::move(without));
            add(std::move(with));
            if (Chain apart = withoutCrossings(open.top().chain); apart.cost < best.cost)
                best = std::move(apart);
        }
        choice.cost = best.cost;
        choice.at_least = open.empty() ? best.cost : std::min(best.cost, open.top().chain.cost);
        for (const std::size_t n : best.planes)
            choice.planes.push_back(all_[n]);
        return choice;
    }

private:
    struct Open {
        Chain chain;
        std::vector<bool> barred;
        bool operator<(const Open& other) const { return chain.cost > other.chain.cost; }  // the cheapest on top
    };

    double costOf(double size) const { return std::pow(std::log(std::max(size, 1.0) / sizes_.target), 2); }
    double badness(std::size_t n) const { return all_[n].badness + (all_[n].good ? 0 : kNotGood); }

    bool cross(std::size_t a, std::size_t b)
    {
        const auto [known, is_new] = known_.try_emplace(std::min(a, b) * all_.size() + std::max(a, b), false);
        if (is_new)
            known->second = intersect(all_[a], all_[b]);
        return known->second;
    }

    /// The cheapest selection of what is not barred, no two that follow each other intersecting.
    Chain solve(const std::vector<bool>& barred)
    {
        const std::size_t count = all_.size();
        std::vector<double> cost(count);
        std::vector<std::size_t> before(count, kNone);
        Chain chain{{}, costOf(sizes_.up_to.back() - sizes_.up_to.front())};
        std::size_t last = kNone, window = 0;
        for (std::size_t n = 0; n < count; ++n) {
            if (barred[n])
                continue;
            cost[n] = costOf(sizes_.between(0, all_[n].at)) + badness(n);
            while (sizes_.between(all_[window].at, all_[n].at) > kLargestChosen * sizes_.target)
                ++window;
            for (std::size_t m = window; m < n; ++m) {
                if (barred[m] || cost[m] + badness(n) >= cost[n])
                    continue;
                const double size = sizes_.between(all_[m].at, all_[n].at);
                if (size < kSmallestChosen * sizes_.target)
                    break;
                const double through = cost[m] + costOf(size) + badness(n);
                if (through < cost[n] && !cross(m, n)) {
                    cost[n] = through;
                    before[n] = m;
                }
            }
            const double ended = cost[n] + costOf(sizes_.up_to.back() - sizes_.up_to[all_[n].at]);
            if (ended < chain.cost) {
                chain.cost = ended;
                last = n;
            }
        }
        for (std::size_t n = last; n != kNone; n = before[n])
            chain.planes.push_back(n);
        std::reverse(chain.planes.begin(), chain.planes.end());
        return chain;
    }

    /// A plane that meets a later one of the chain.
    std::optional<std::size_t> firstThatMeets(const Chain& chain)
    {
        for (std::size_t b = 1; b < chain.planes.size(); ++b)
            for (std::size_t a = 0; a < b; ++a)
                if (cross(chain.planes[a], chain.planes[b]))
                    return chain.planes[a];
        return std::nullopt;
    }

    /// What meets an earlier plane of the chain is dropped, and the segments beside it become one.
    Chain withoutCrossings(const Chain& chain)
    {
        Chain apart;
        std::size_t from = 0;
        for (const std::size_t n : chain.planes) {
            if (std::any_of(apart.planes.begin(), apart.planes.end(), [&](std::size_t m) { return cross(m, n); }))
                continue;
            apart.planes.push_back(n);
            apart.cost += costOf(sizes_.between(from, all_[n].at)) + badness(n);
            from = all_[n].at;
        }
        apart.cost += costOf(sizes_.up_to.back() - sizes_.up_to[from]);
        return apart;
    }

    const std::vector<CutPlane>& all_;
    const PathSizes& sizes_;
    Progress& progress_;
    std::unordered_map<std::size_t, bool> known_;  // whether two planes intersect, once it was asked
};

}  // namespace

PortalChoice choosePortals(const PlanesAt& planes, const PathSizes& sizes, Progress& progress, int most_solved)
{
    const std::vector<CutPlane> all = allPlanes(planes, sizes.up_to.size());
    progress.check();
    return Choice(all, sizes, progress).choose(most_solved);
}

}  // namespace vicon::steps

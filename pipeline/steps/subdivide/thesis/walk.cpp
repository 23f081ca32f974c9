#include "subdivide/thesis/walk.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicon::steps {
namespace {

// No case recorded; the thesis names no numbers. What comes out stands in docs/evaluation/subdivision.md. Half of
// kFeasible makes 99 segments of ctc-prone's 63, half of kTooLarge 79, half of kLeast 66; double of any at least 58;
// the limits of the optimum are not met.

/// A segment is feasible from this part of its target on, and too large beyond that one.
constexpr double kFeasible = 0.8, kTooLarge = 1.5;
/// No earlier candidate is taken that would make a segment smaller than this part of the target.
constexpr double kLeast = 0.4;
/// The global optimum considers segments of these parts of the target.
constexpr double kSmallestChosen = 0.25, kLargestChosen = 4;

bool intersectsAny(const CutPlane& plane, const std::vector<CutPlane>& accepted)
{
    return std::any_of(accepted.rbegin(), accepted.rend(), [&](const CutPlane& a) { return intersect(plane, a); });
}

}  // namespace

std::vector<CutPlane> walkLocally(const PlanesAt& planes, const PathSizes& sizes, Progress& progress)
{
    std::vector<CutPlane> accepted;
    std::optional<CutPlane> best;
    std::size_t last = 0;
    bool accept_next = false;
    const auto accept = [&](CutPlane plane) {
        last = plane.at;
        accepted.push_back(std::move(plane));
        best.reset();
        accept_next = false;
    };
    for (std::size_t n = 1; n + 1 < sizes.up_to.size(); ++n) {
        progress.check();
        const double size = sizes.between(last, n) / sizes.target;
        if (size < kLeast || sizes.up_to.back() - sizes.up_to[n] < kLeast * sizes.target)
            continue;
        std::optional<CutPlane> candidate;
        for (CutPlane& plane : planes(n)) {
            if (intersectsAny(plane, accepted))
                continue;
            if ((plane.good && size >= kFeasible) || accept_next) {
                if (!candidate || plane.badness < candidate->badness)
                    candidate = std::move(plane);
            } else if (!best || plane.badness < best->badness) {
                best = std::move(plane);
            }
        }
        if (candidate) {
            accept(std::move(*candidate));
        } else if (size > kTooLarge) {
            if (best) {
                // Back to the earlier candidate; the walk goes on from there.
                n = best->at;
                accept(std::move(*best));
            } else {
                accept_next = true;
            }
        }
    }
    return accepted;
}

std::vector<CutPlane> choosePortals(const PlanesAt& planes, const PathSizes& sizes, Progress& progress)
{
    std::vector<std::vector<CutPlane>> at(sizes.up_to.size());
    tbb::parallel_for(std::size_t(1), at.size() - 1, [&](std::size_t n) { at[n] = planes(n); });
    progress.check();
    std::vector<CutPlane> all;
    for (auto& some : at)
        std::move(some.begin(), some.end(), std::back_inserter(all));

    const auto costOf = [&](double size) { return std::pow(std::log(std::max(size, 1.0) / sizes.target), 2); };
    const double total = sizes.up_to.back() - sizes.up_to.front();
    constexpr auto kNone = std::numeric_limits<std::size_t>::max();
    std::vector<double> cost(all.size());
    std::vector<std::size_t> before(all.size(), kNone);
    double least = costOf(total);
    std::size_t last = kNone, window = 0;
    for (std::size_t n = 0; n < all.size(); ++n) {
        const double badness = all[n].badness + (all[n].good ? 0 : 1);
        cost[n] = costOf(sizes.between(0, all[n].at)) + badness;
        while (sizes.between(all[window].at, all[n].at) > kLargestChosen * sizes.target)
            ++window;
        for (std::size_t m = window; m < n; ++m) {
            const double size = sizes.between(all[m].at, all[n].at);
            if (size < kSmallestChosen * sizes.target)
                break;
            const double through = cost[m] + costOf(size) + badness;
            if (through < cost[n] && !intersect(all[m], all[n])) {
                cost[n] = through;
                before[n] = m;
            }
        }
        if (const double ended = cost[n] + costOf(sizes.up_to.back() - sizes.up_to[all[n].at]); ended < least) {
            least = ended;
            last = n;
        }
        if (n % 64 == 0)
            progress.check();
    }
    std::vector<CutPlane> chosen;
    for (std::size_t n = last; n != kNone; n = before[n])
        chosen.push_back(all[n]);
    std::reverse(chosen.begin(), chosen.end());
    // The programme compares neighbours only; where the lumen turns back on itself, others may meet.
    std::vector<CutPlane> apart;
    for (CutPlane& plane : chosen)
        if (!intersectsAny(plane, apart))
            apart.push_back(std::move(plane));
    return apart;
}

}  // namespace vicon::steps

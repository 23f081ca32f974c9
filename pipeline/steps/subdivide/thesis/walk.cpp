#include "subdivide/thesis/walk.h"

#include <algorithm>
#include <optional>

namespace vicon::steps {
namespace {

// No case recorded; the thesis names no numbers. What comes out stands in docs/evaluation/subdivision.md. Half of
// kFeasible makes 99 segments of ctc-prone's 63, half of kTooLarge 79, half of kLeast 66; double of any at least 58.

/// A segment is feasible from this part of its target on, and too large beyond that one.
constexpr double kFeasible = 0.8, kTooLarge = 1.5;
/// No earlier candidate is taken that would make a segment smaller than this part of the target.
constexpr double kLeast = 0.4;

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

}  // namespace vicon::steps

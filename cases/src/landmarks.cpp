#include "landmarks.h"

#include <algorithm>

namespace vicon {
namespace {

// How far the wall under a landmark lies from the other scan's: the errors of both (docs/evaluation,
// lumen-and-centreline.md) and what the wall slides past it. Seen on stretched phantoms, seeds 21 to 25: ends 5,
// descending colon 27, others 7 to 12 mm.
constexpr double kEnd_mm = 8;

struct Mark {
    ColonPart part;
    double at;  ///< 0: where the part begins, 1: where it ends
    double deviation_mm;
};
constexpr Mark kMarks[] = {{ColonPart::sigmoid, 0, 16},
                           {ColonPart::descending, 0, 30},
                           {ColonPart::splenic_flexure, 0.5, 16},
                           {ColonPart::hepatic_flexure, 0.5, 16}};

}  // namespace

const ColonPartRange* rangeOf(const ColonPartRanges& parts, ColonPart part)
{
    const auto found = std::find_if(parts.begin(), parts.end(), [&](const auto& range) { return range.part == part; });
    return found == parts.end() || found->to_mm <= found->from_mm ? nullptr : &*found;
}

std::vector<LandmarkPair> sharedLandmarks(const ColonProfile& from, const ColonProfile& to)
{
    std::vector<LandmarkPair> pairs{{0, 0, kEnd_mm}};
    const auto add = [&](LandmarkPair pair) {
        if (pair.from_mm > pairs.back().from_mm && pair.to_mm > pairs.back().to_mm)
            pairs.push_back(pair);
    };
    for (const Mark& mark : kMarks) {
        const ColonPartRange *here = rangeOf(from.parts, mark.part), *there = rangeOf(to.parts, mark.part);
        if (!here || !there)
            continue;
        const auto at = [&](const ColonPartRange& range) {
            return range.from_mm + mark.at * (range.to_mm - range.from_mm);
        };
        if (at(*here) < from.length_mm && at(*there) < to.length_mm)
            add({at(*here), at(*there), mark.deviation_mm});
    }
    add({from.length_mm, to.length_mm, kEnd_mm});
    return pairs;
}

}  // namespace vicon

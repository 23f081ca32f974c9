#include "vicon/viewer/model/correspondence.h"

#include <algorithm>

namespace vicon::viewer {
namespace {

const ColonPartRange* rangeOf(const ColonPartRanges& parts, ColonPart part)
{
    const auto found = std::find_if(parts.begin(), parts.end(), [&](const auto& range) { return range.part == part; });
    return found == parts.end() ? nullptr : &*found;
}

}  // namespace

double correspondingStation_mm(const ColonScale& from, double station_mm, const ColonScale& to)
{
    const double station = std::clamp(station_mm, 0.0, from.length_mm);
    // Piecewise linear between places that both know: the two ends and where parts that both have begin.
    double low_from = 0, low_to = 0, high_from = from.length_mm, high_to = to.length_mm;
    for (const ColonPartRange& range : from.parts) {
        const ColonPartRange* other = rangeOf(to.parts, range.part);
        const bool absent = range.to_mm <= range.from_mm || (other && other->to_mm <= other->from_mm);
        if (!other || absent)
            continue;  // a part of no length has no beginning that means anything
        const double here = std::clamp(range.from_mm, 0.0, from.length_mm);
        const double there = std::clamp(other->from_mm, 0.0, to.length_mm);
        if (here <= station && there >= low_to) {
            low_from = here;
            low_to = there;
        } else if (here > station && there >= low_to) {
            high_from = here;
            high_to = there;
            break;
        }
    }
    const double part = high_from > low_from ? (station - low_from) / (high_from - low_from) : 0;
    return low_to + part * (high_to - low_to);
}

}  // namespace vicon::viewer

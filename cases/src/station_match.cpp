#include <algorithm>
#include <cmath>

#include "landmarks.h"
#include "station_chain.h"
#include "vicon/cases/station_map.h"

namespace vicon {
namespace {

constexpr double kShortest_mm = 100;  // shorter ones are no colons

MapSource plainSource(const std::vector<LandmarkPair>& marks)
{
    return marks.size() > 2 ? MapSource::landmarks : MapSource::fraction;  // beside the ends
}

/// Where no chain passes, as with a colon of which one scan shows half: by landmarks, and anywhere around.
StationMap unmatched(const ColonProfile& from, const ColonProfile& to)
{
    const std::vector<LandmarkPair> marks = sharedLandmarks(from, to);
    StationMap map{plainSource(marks), from.length_mm, to.length_mm, {}, {}};
    for (std::size_t part = 0; part + 1 < marks.size(); ++part) {
        const LandmarkPair &a = marks[part], &b = marks[part + 1];
        const int steps = int((b.from_mm - a.from_mm) / StationChain::kStep_mm) + 1;
        for (int n = part == 0 ? 0 : 1; n <= steps; ++n) {
            const double share = double(n) / steps, there = std::lerp(a.to_mm, b.to_mm, share);
            map.from_mm.push_back(std::lerp(a.from_mm, b.from_mm, share));
            map.to.push_back({there, std::max(0.0, there - StationChain::kReach_mm),
                              std::min(to.length_mm, there + StationChain::kReach_mm)});
        }
    }
    return map;
}

}  // namespace

StationMap matchStations(const ColonProfile& from, const ColonProfile& to, const Progress* wanted)
{
    if (std::min(from.length_mm, to.length_mm) < kShortest_mm)
        return unmatched(from, to);
    const StationChain chain(from, to, wanted);
    if (!chain.passes())
        return unmatched(from, to);
    StationMap map = chain.map();
    if (!chain.seesWall())
        map.source = plainSource(sharedLandmarks(from, to));
    return map;
}

}  // namespace vicon

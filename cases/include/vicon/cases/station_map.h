#pragma once

#include <vector>

#include "vicon/cases/wall_relief.h"
#include "vicon/core/colon_parts.h"
#include "vicon/core/progress.h"
#include "vicon/core/scan_quality.h"
#include "vicon/core/skeleton.h"

namespace vicon {

/// What is known of a scan's colon along its centreline, to find the same places of two scans by.
struct ColonProfile {
    double length_mm = 0;
    ColonPartRanges parts;              ///< empty where they are not known
    std::vector<double> width_mm;       ///< radius of a disc as large as the cross-section, each mm; 0: not known
    std::vector<double> clearance_mm;   ///< from the centreline to the wall, each mm; 0: not known
    std::vector<StationRange> bridges;  ///< over collapsed parts: their length says little
    WallRelief relief;                  ///< empty where the lumen was not looked at
};
/// Without the relief, which reliefOf() makes. @param along of the scan's quality; may be empty
ColonProfile profileOf(const Skeleton& skeleton, const ColonPartRanges& parts, const LumenAlong& along);

/// Where a place of one scan lies in another.
struct StationInterval {
    double station_mm = 0;
    double least_mm = 0, most_mm = 0;  ///< it lies between with a probability of 80 %
};

/// What a map was made by.
enum class MapSource {
    wall,       ///< folds and width along both centrelines, held by the landmarks that both know
    landmarks,  ///< these alone
    fraction,   ///< of the length; neither wall nor landmarks are known
};
/// "folds and width", "landmarks", "fraction of the length".
std::string nameOf(MapSource source);

/// The stations of one scan in another. Rises everywhere.
struct StationMap {
    MapSource source = MapSource::fraction;
    double from_length_mm = 0, to_length_mm = 0;
    std::vector<double> from_mm;      ///< ascending, from 0 to the length
    std::vector<StationInterval> to;  ///< of each of them

    /// Interpolated; stations beyond the ends count as the ends. Of a map of nothing: 0.
    StationInterval at(double station_mm) const;
    /// The same map read the other way.
    StationMap reversed() const;
};

/// The same places of two scans of one colon.
///
/// A hidden Markov chain runs along the first centreline in steps of 10 mm; its state is the station in the other scan,
/// how fast that advances (0.5 to 1.5 mm a mm) and by how much the wall is turned there. What it sees are folds and
/// haustra (the relief, the clearance's and the width's ripple) and how wide the colon is; nothing over bridges. Ends
/// and landmarks (the rectum's end, the descending colon's begin, both flexures) hold it loosely. Forward and backward
/// pass give the probability of every station at every station; its middle is the map, its middle 80 % the interval.
/// Where no chain passes, as when one scan shows half of the colon, the map is by landmarks, and its interval 130 mm to
/// either side. Throws Error{cancelled} where `wanted` is no longer.
StationMap matchStations(const ColonProfile& from, const ColonProfile& to, const Progress* wanted = nullptr);

}  // namespace vicon

#pragma once

#include "vicon/core/colon_parts.h"

namespace vicon::viewer {

/// A scan's colon as a scale of stations.
struct ColonScale {
    double length_mm = 0;
    ColonPartRanges parts;  ///< empty where they are not known
};

/// The station of one scan that shows the same place as a station of the other: the same fraction of the same named
/// part where both know their parts, else the same fraction of the whole way. It never runs back while `station_mm`
/// runs on. Stations beyond the ends count as the ends.
double correspondingStation_mm(const ColonScale& from, double station_mm, const ColonScale& to);

}  // namespace vicon::viewer

#pragma once

#include <array>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/skeleton.h"
#include "vicon/core/volume_view.h"

namespace vicon {

/// How far the wall stands from a centreline, all about it.
struct WallRelief {
    static constexpr std::size_t kDirections = 36;  ///< evenly about the centreline
    /// At each mm, across the centreline; 0 on bridges. The first direction turns about the centreline no more than its
    /// bends ask for; the others follow it clockwise, seen towards the caecum. Scans of one colon differ by a turn that
    /// changes slowly along the way.
    std::vector<std::array<float, kDirections>> radius_mm;
};

/// Along rays through the lumen's mask; hundredths of a second. Throws Error{cancelled} where `wanted` is no longer.
WallRelief reliefOf(const InsideView& inside, const Skeleton& skeleton, const Progress* wanted = nullptr);

}  // namespace vicon

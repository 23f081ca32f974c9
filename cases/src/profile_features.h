#pragma once

#include <array>
#include <vector>

#include "vicon/cases/station_map.h"

namespace vicon {

/// What of the wall is compared along a centreline, at each mm.
struct ProfileFeatures {
    static constexpr std::size_t kCount = 3;  ///< ripple of the clearance, ripple of the width, the width itself
    /// In standard deviations of the scan; mean 0. Empty where the profile does not have it.
    std::array<std::vector<float>, kCount> value;
    /// Folds about the centreline, in standard deviations of their neighbourhood. Empty where the profile has no
    /// relief.
    static constexpr std::size_t kSectors = 18;
    std::vector<std::array<float, kSectors>> folds;
    std::vector<float> known;  ///< 0 where nothing is to be seen: on bridges and beside them; else 1
};
ProfileFeatures featuresOf(const ColonProfile& profile);

}  // namespace vicon

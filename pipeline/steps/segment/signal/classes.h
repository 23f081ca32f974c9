#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The values between the classes that Otsu's method parts, the lowest first (N. Otsu, IEEE Transactions on Systems,
/// Man, and Cybernetics 9, 1979). Padding counts as 0.
/// @param count of values, that is one less than classes
std::vector<double> classLimits(const HuVolume& signal, unsigned count);

/// The middle one in order; `otherwise` where there is none. Changes the order.
inline double middleOf(std::vector<std::int16_t>& signals, double otherwise = 0)
{
    if (signals.empty())
        return otherwise;
    const auto middle = signals.begin() + std::ptrdiff_t(signals.size() / 2);
    std::nth_element(signals.begin(), middle, signals.end());
    return *middle;
}

}  // namespace vicon::steps

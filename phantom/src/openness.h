#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace vicon::phantom {

inline constexpr double kGapRamp_mm = 10;  ///< over which the lumen closes

/// What gaps leave of the lumen: 1 far from them, 0 within. @param gaps with from_mm and to_mm
template <class Gap>
double openness(const std::vector<Gap>& gaps, double station_mm)
{
    double open = 1;
    for (const Gap& gap : gaps) {
        const double away = std::max(gap.from_mm - station_mm, station_mm - gap.to_mm);
        const double u = 1 - std::clamp(away / kGapRamp_mm, 0.0, 1.0);
        open = std::min(open, std::sqrt(std::max(0.0, 1 - u * u)));
    }
    return open;
}

}  // namespace vicon::phantom

#pragma once

#include <cstdint>

namespace vicon::steps {

/// The nearest whole HU, halves upwards. Of densities from -32768 to 32767.
inline std::int16_t rounded(float hu)
{
    // Makes every HU positive, for truncation; the values of floats of that size are a thousandth apart.
    constexpr float kAboveAllHu = 32768;
    return std::int16_t(std::int32_t(hu + (kAboveAllHu + 0.5F)) - std::int32_t(kAboveAllHu));
}

}  // namespace vicon::steps

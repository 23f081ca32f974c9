#pragma once

#include <algorithm>

#include "vicon/viewer/model/overlay.h"

namespace vicon::viewer {

/// A colour drawn towards a tint, its shading still readable.
/// @param bright the tint's brightness that stands for the colour's own
inline Rgb towards(Rgb own, Rgb tint, std::uint8_t bright)
{
    constexpr double kStrength = 0.55;
    const std::uint8_t brightness = std::max({own.red, own.green, own.blue});
    const auto tinted = [&](std::uint8_t from, std::uint8_t to) {
        const double wanted = double(brightness) * to / bright;
        return std::uint8_t(std::clamp(from + kStrength * (wanted - from), 0.0, 255.0));
    };
    return {tinted(own.red, tint.red), tinted(own.green, tint.green), tinted(own.blue, tint.blue)};
}

/// The colour of wall that was seen. Green is far from mucosa and from the markers' rings by its darkness.
inline Rgb seenTint(Rgb own)
{
    constexpr Rgb kSeen{70, 190, 110};
    return towards(own, kSeen, kSeen.green);
}

/// Of a region that was missed: mucosa is pink, and the yellow marker's ring paler.
inline Rgb missedTint(Rgb own)
{
    constexpr Rgb kMissed{255, 120, 20};
    return towards(own, kMissed, kMissed.red);
}

}  // namespace vicon::viewer

#pragma once

#include <cstdint>

#include "vicon/core/volume.h"

namespace vicon::phantom {

/// The ideal signal of a gradient echo with fat suppressed, from the ideal densities of the same patient: the lumen is
/// dark or bright, its wall and muscle are bright, fat is fainter, bone and air give none.
/// @param lumen of the colon
HuVolume signalScene(const HuVolume& scene_hu, const InsideVolume& lumen, bool bright);

/// What coils make of it: a smooth shading of up to 1.9 from the darkest to the brightest place of the trunk, and noise
/// of a magnitude (S. O. Rice's distribution) with the standard deviation kSignalNoise. No value is padding.
/// @param study_seed draws the shading, `noise_seed` the noise
void receive(HuVolume& signal, std::uint64_t study_seed, std::uint64_t noise_seed);

/// A twentieth of the wall's signal.
inline constexpr double kSignalNoise = 20;

}  // namespace vicon::phantom

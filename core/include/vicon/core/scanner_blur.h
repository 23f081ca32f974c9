#pragma once

namespace vicon {

/// Standard deviation of a scanner's blur with a soft kernel, where nothing in the scan shows it. Phantoms are drawn
/// with 0.5 to 0.8 mm; ctc-prone's fluid levels show 0.7 mm.
inline constexpr double kUsualBlur_mm = 0.7;
/// The same of noise: phantoms are drawn with 15 to 40 HU, ctc-prone shows 28 HU.
inline constexpr double kUsualNoise_hu = 25;

/// Of a scan, standard deviations.
struct BlurAndNoise {
    double blur_mm = kUsualBlur_mm;
    double noise_hu = kUsualNoise_hu;
};

}  // namespace vicon

#pragma once

namespace vicon {

/// Standard deviation of a scanner's blur with a soft kernel, where nothing in the scan shows it. Phantoms are drawn
/// with 0.5 to 0.8 mm; ctc-prone's fluid levels show 0.7 mm.
inline constexpr double kUsualBlur_mm = 0.7;

}  // namespace vicon

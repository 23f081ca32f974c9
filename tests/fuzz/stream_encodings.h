#pragma once

#include <string_view>

namespace vicon::fuzz {

/// The encodings that the harness of the guards chooses from, by number.
inline constexpr std::string_view kStreamEncodings[] = {
    "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.81",
    "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.57", "1.2.840.10008.1.2.4.51", "1.2.840.10008.1.2.5"};
inline constexpr std::string_view kRle = kStreamEncodings[7];

}  // namespace vicon::fuzz

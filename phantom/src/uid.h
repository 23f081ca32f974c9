#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vicon::phantom {

/// A unique identifier under 2.25 (a number of 128 bits) that follows from the seed and what it names.
std::string uidFor(std::uint64_t seed, std::string_view what, std::uint64_t number = 0);

/// Eight hexadecimal digits in no order.
std::string shuffledName(std::uint64_t seed, std::string_view what, std::uint64_t number);

}  // namespace vicon::phantom

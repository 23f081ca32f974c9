#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "memory_file.h"

namespace vicon::fuzz {

/// Ends the run unless a text is some words, for a person, that end no line.
inline void requireLine(const std::string& line)
{
    constexpr std::size_t kLongest = 1000;
    require(!line.empty() && line.size() <= kLongest);
    require(std::none_of(line.begin(), line.end(), [](char c) { return std::uint8_t(c) < 0x20 || c == 0x7f; }));
    (void)nlohmann::json(line).dump();  // throws where it is no UTF-8
}

}  // namespace vicon::fuzz

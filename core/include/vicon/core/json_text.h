#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace vicon {

/// Text as JSON; discarded (json.is_discarded()) where it is none, or is nested deeper than kDeepestJson: copying,
/// comparing and writing JSON take stack for every level.
nlohmann::json parsedJson(std::string_view text);

/// The files that VICON exchanges nest five or six levels.
inline constexpr int kDeepestJson = 100;

/// A whole number that fits an int. Throws nlohmann::json::exception for everything else, also for a number that does
/// not fit: converting it would mean nothing.
int wholeNumber(const nlohmann::json& json);

/// wholeNumber() of a key; `missing` where it is not there.
int wholeNumber(const nlohmann::json& json, const char* key, int missing);

/// A count: 0 or more, and not more than a double can count. Throws as wholeNumber() does.
std::size_t wholeCount(const nlohmann::json& json);

}  // namespace vicon

#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vicon/core/error.h"

namespace vicon {

/// The names of an enumeration, in the order in which they are offered; a value may have further names after its first.
template <class Enum, std::size_t N>
using EnumNames = std::array<std::pair<Enum, const char*>, N>;

/// The first name of a value.
template <class Enum, std::size_t N>
std::string nameIn(const EnumNames<Enum, N>& names, Enum value)
{
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& row) { return row.first == value; });
    return found == names.end() ? "" : found->second;
}

/// All names, for a list of choices.
template <class Enum, std::size_t N>
std::vector<std::string> namesOf(const EnumNames<Enum, N>& names)
{
    std::vector<std::string> out;
    for (const auto& row : names)
        out.emplace_back(row.second);
    return out;
}

/// The value of that name. Throws Error{wrong_use}, which lists the names.
/// @param what the thing named, as in "a finding's kind"
template <class Enum, std::size_t N>
Enum valueIn(const EnumNames<Enum, N>& names, std::string_view name, const std::string& what)
{
    std::string all;
    for (const auto& [value, known] : names) {
        if (name == known)
            return value;
        all += (all.empty() ? "" : ", ") + std::string(known);
    }
    throw Error(ErrorCode::wrong_use, what + " cannot be '" + std::string(name) + "'", {}, "it is one of: " + all);
}

}  // namespace vicon

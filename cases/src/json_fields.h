#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "vicon/core/error.h"

namespace vicon {

// Optional fields of the records that are kept as JSON: absent where there is nothing.

template <class Value>
void putValue(nlohmann::json& out, const char* key, const std::optional<Value>& value)
{
    if (value)
        out[key] = *value;
}

/// An enumeration, by its name.
template <class Enum>
void putName(nlohmann::json& out, const char* key, const std::optional<Enum>& value)
{
    if (value)
        out[key] = nameOf(*value);
}

inline std::optional<double> number(const nlohmann::json& from, const char* key)
{
    return from.contains(key) ? std::optional(from.at(key).get<double>()) : std::nullopt;
}

template <class Enum>
std::optional<Enum> named(const nlohmann::json& from, const char* key, Enum (*value_of)(const std::string&))
{
    return from.contains(key) ? std::optional(value_of(from.at(key).get<std::string>())) : std::nullopt;
}

/// What `read` returns. Throws Error{bad_input} where the JSON is none of what is read.
template <class Read>
auto understood(const char* what, Read read)
{
    try {
        return read();
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::bad_input, std::string("not ") + what + ": " + e.what(), what);
    } catch (const Error& e) {
        throw Error(ErrorCode::bad_input, std::string("not ") + what + ": " + e.what(), what);
    }
}

}  // namespace vicon

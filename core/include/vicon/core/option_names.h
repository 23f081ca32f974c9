#pragma once

#include <nlohmann/json.hpp>
#include <type_traits>

#include "vicon/core/enum_names.h"
#include "vicon/core/options.h"

namespace vicon {

/// An enumeration that an option can be: optionNames(Enum) hands back its names. In JSON, files and on the command line
/// it is its name.
template <class Enum>
concept OptionEnum = std::is_enum_v<Enum> && requires(Enum value)
{
    optionNames(value);
};

/// For visit(): an option of this type is one of its names.
template <OptionEnum Enum>
OptionLimits choicesOf(Enum value)
{
    return {.choices = namesOf(optionNames(value))};
}

}  // namespace vicon

template <class Enum>
struct nlohmann::adl_serializer<Enum, std::enable_if_t<vicon::OptionEnum<Enum>>> {
    static void to_json(json& out, Enum value) { out = vicon::nameIn(optionNames(value), value); }
    /// Throws vicon::Error{wrong_use}.
    static void from_json(const json& from, Enum& value)
    {
        value = vicon::valueIn(optionNames(Enum{}), from.get<std::string>(), "an option");
    }
};

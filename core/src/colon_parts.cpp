#include "vicon/core/colon_parts.h"

#include <array>

#include "vicon/core/error.h"

namespace vicon {
namespace {

constexpr std::array<const char*, 8> kNames = {"rectum",     "sigmoid",         "descending", "splenic flexure",
                                               "transverse", "hepatic flexure", "ascending",  "caecum"};

}  // namespace

std::string nameOf(ColonPart part)
{
    return kNames.at(std::size_t(part));
}

ColonPart colonPartFrom(const std::string& name)
{
    for (std::size_t n = 0; n < kNames.size(); ++n)
        if (name == kNames[n])
            return ColonPart(n);
    throw Error(ErrorCode::bad_input, "no such part of the colon", "'" + name + "'");
}

nlohmann::json toJson(const ColonPartRanges& parts)
{
    nlohmann::json list = nlohmann::json::array();
    for (const ColonPartRange& range : parts)
        list.push_back({{"name", nameOf(range.part)}, {"from_mm", range.from_mm}, {"to_mm", range.to_mm}});
    return list;
}

ColonPartRanges colonPartsFromJson(const nlohmann::json& json)
{
    ColonPartRanges parts;
    try {
        for (const nlohmann::json& entry : json)
            parts.push_back({colonPartFrom(entry.at("name").get<std::string>()), entry.at("from_mm").get<double>(),
                             entry.at("to_mm").get<double>()});
    } catch (const nlohmann::json::exception& problem) {
        throw Error(ErrorCode::bad_input, "the parts of the colon are not as they should be", problem.what());
    }
    return parts;
}

std::string partNameAt(const ColonPartRanges& parts, double station_mm)
{
    for (const ColonPartRange& range : parts)
        if (station_mm < range.to_mm)
            return nameOf(range.part);
    return parts.empty() ? "" : nameOf(parts.back().part);
}

}  // namespace vicon

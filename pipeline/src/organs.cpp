#include "vicon/pipeline/organs.h"

#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "organ_presets.h"
#include "vicon/core/error.h"

namespace vicon::pipeline {
namespace {

const OrganPreset& presetOf(const std::string& name)
{
    const auto& presets = organPresets();
    const auto at =
        std::find_if(presets.begin(), presets.end(), [&](const OrganPreset& preset) { return preset.name == name; });
    if (at != presets.end())
        return *at;
    std::string known;
    for (const std::string& other : organNames())
        known += (known.empty() ? "" : ", ") + other;
    throw Error(ErrorCode::wrong_use, "there is no organ '" + name + "'", "organ", "name one of " + known);
}

std::string textOf(const toml::node& node)
{
    if (const auto* text = node.as_string())
        return text->get();
    std::ostringstream out;
    if (const auto* number = node.as_floating_point())
        out << number->get();
    else if (const auto* whole = node.as_integer())
        out << whole->get();
    else if (const auto* truth = node.as_boolean())
        out << (truth->get() ? "true" : "false");
    return out.str();
}

}  // namespace

std::vector<std::string> organNames()
{
    std::vector<std::string> names;
    for (const OrganPreset& preset : organPresets())
        names.emplace_back(preset.name);
    return names;
}

Config withOrgan(Config config, const std::optional<Organ>& organ)
{
    const OrganPreset& preset = presetOf(organ ? organ->name() : config.at("organ.name").value.get<std::string>());
    const toml::table root = toml::parse(preset.toml);
    for (const auto& [room, table] : root)
        for (const auto& [key, node] : *table.as_table()) {
            const std::string full = std::string(room.str()) + "." + std::string(key.str());
            if (full == "organ.name" || full == "organ.title" || config.at(full).source == "default")
                config.set(full + "=" + textOf(node));
        }
    return config;
}

}  // namespace vicon::pipeline

#include "vicon/pipeline/organs.h"

#include <toml++/toml.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "organ_presets.h"
#include "vicon/core/error.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;
using nlohmann::json;

namespace vicon::pipeline {
namespace {

constexpr const char* kFile = "organ.json";

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

std::string readOrgan(const fs::path& scan_folder)
{
    const fs::path file = scan_folder / kFile;
    if (!fs::exists(file))
        return {};
    const json said = json::parse(readFile(file), nullptr, false);
    if (!said.is_object() || !said.value("organ", json()).is_string())
        throw Error(ErrorCode::bad_input, "this does not name an organ", file.string(),
                    "name it again with 'vicon work --organ NAME --case CASE'");
    return said["organ"].get<std::string>();
}

void writeOrgan(const fs::path& scan_folder, const std::string& name)
{
    presetOf(name);
    replaceFile(scan_folder / kFile, json{{"organ", name}}.dump(2) + "\n");
}

Config withOrgan(Config config, const std::string& name)
{
    const OrganPreset& preset = presetOf(name.empty() ? config.at("organ.name").value.get<std::string>() : name);
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

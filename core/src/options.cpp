#include "vicon/core/options.h"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "vicon/core/error.h"
#include "vicon/core/nearest_name.h"

namespace vicon {
namespace {

/// A list of texts has no unit; one of points has.
bool isListOfTexts(const OptionSpec& spec)
{
    return spec.default_value.is_array() && spec.unit.empty();
}

std::string typeName(const OptionSpec& spec)
{
    const nlohmann::json& value = spec.default_value;
    if (isListOfTexts(spec))
        return "a list of texts: [\"one\", \"two\"], or \"one,two\"";
    if (value.is_boolean())
        return "true or false";
    if (value.is_number_integer())
        return "a whole number";
    if (value.is_array())
        return "points: [[x, y, z], ...], or \"x,y,z;x,y,z\"";
    return value.is_number() ? "a number" : "a text in quotes";
}

nlohmann::json fromToml(const toml::node& node)
{
    if (const auto* v = node.as_boolean())
        return v->get();
    if (const auto* v = node.as_integer())
        return v->get();
    if (const auto* v = node.as_floating_point())
        return v->get();
    if (const auto* v = node.as_string())
        return v->get();
    if (const auto* v = node.as_array()) {
        nlohmann::json all = nlohmann::json::array();
        for (const toml::node& entry : *v)
            all.push_back(fromToml(entry));
        return all;
    }
    return nullptr;
}

bool isPoint(const nlohmann::json& value)
{
    return value.is_array() && value.size() == 3 && std::all_of(value.begin(), value.end(), [](const auto& coordinate) {
               return coordinate.is_number() && std::isfinite(coordinate.template get<double>());
           });
}

/// Points from "x,y,z;x,y,z"; the text itself where it is none.
nlohmann::json pointsFrom(const std::string& text)
{
    nlohmann::json points = nlohmann::json::array();
    std::istringstream list(text);
    for (std::string entry; std::getline(list, entry, ';');) {
        if (entry.find_first_not_of(" \t") == std::string::npos)
            continue;
        const auto point = nlohmann::json::parse("[" + entry + "]", nullptr, false);
        if (!isPoint(point))
            return text;
        points.push_back(point);
    }
    return points;
}

/// Texts from "one,two", without the blanks around them.
nlohmann::json textsFrom(const std::string& text)
{
    constexpr const char* kBlanks = " \t";
    nlohmann::json texts = nlohmann::json::array();
    std::istringstream list(text);
    for (std::string entry; std::getline(list, entry, ',');)
        if (const auto from = entry.find_first_not_of(kBlanks); from != std::string::npos)
            texts.push_back(entry.substr(from, entry.find_last_not_of(kBlanks) - from + 1));
    return texts;
}

/// A list from its text on one line; another text as it is.
nlohmann::json listFrom(const std::string& text, const OptionSpec& spec)
{
    return isListOfTexts(spec) ? textsFrom(text) : pointsFrom(text);
}

nlohmann::json fromText(const std::string& text, const OptionSpec& spec)
{
    if (spec.default_value.is_string())
        return text;
    const auto parsed = nlohmann::json::parse(text, nullptr, false);
    if (spec.default_value.is_array() && !parsed.is_array())
        return listFrom(text, spec);
    return parsed.is_discarded() ? nlohmann::json(text) : parsed;
}

bool sameKind(const nlohmann::json& value, const OptionSpec& spec)
{
    const nlohmann::json& like = spec.default_value;
    if (isListOfTexts(spec))
        return value.is_array() &&
               std::all_of(value.begin(), value.end(), [](const auto& entry) { return entry.is_string(); });
    if (like.is_boolean())
        return value.is_boolean();
    if (like.is_number_integer())
        return value.is_number_integer();
    if (like.is_number())
        return value.is_number();
    if (like.is_array())
        return value.is_array() && std::all_of(value.begin(), value.end(), isPoint);
    return value.is_string();
}

/// What is no text is no configuration: an empty one would be read from a folder, and no end from a device.
std::string configurationIn(const std::filesystem::path& file)
{
    constexpr std::size_t kLongest = 1 << 20;
    std::ifstream in(file, std::ios::binary);
    std::string text;
    std::array<char, 4096> block{};
    while (text.size() <= kLongest && (in.read(block.data(), block.size()) || in.gcount() > 0))
        text.append(block.data(), std::size_t(in.gcount()));
    if (!in.is_open() || in.bad())
        throw Error(ErrorCode::wrong_use, "the configuration cannot be read", file.string(),
                    "name a file that this user may read");
    if (text.size() > kLongest)
        throw Error(ErrorCode::wrong_use, "is longer than any configuration", file.string(), "name another file");
    return text;
}

}  // namespace

void Config::declare(const std::vector<OptionSpec>& specs)
{
    for (const OptionSpec& spec : specs) {
        specs_.push_back(spec);
        values_[spec.key] = {spec.default_value, "default"};
    }
}

const Config::Value& Config::at(const std::string& key) const
{
    const auto found = values_.find(key);
    if (found == values_.end())
        throw Error(ErrorCode::internal, "option is not declared", key);
    return found->second;
}

const OptionSpec& Config::specFor(const std::string& key, const std::string& source) const
{
    std::vector<std::string> keys;
    for (const OptionSpec& spec : specs_) {
        if (spec.key == key)
            return spec;
        keys.push_back(spec.key);
    }
    constexpr std::size_t kMostLetters = 4;
    const std::string nearest = nearestName(key, keys, kMostLetters);
    throw Error(ErrorCode::wrong_use, "unknown option '" + key + "'", source,
                nearest.empty() ? "'vicon config' lists all options" : "did you mean '" + nearest + "'?");
}

void Config::assign(const std::string& key, nlohmann::json value, const std::string& source)
{
    const OptionSpec& spec = specFor(key, source);
    if (spec.default_value.is_array() && value.is_string())
        value = listFrom(value.get<std::string>(), spec);
    if (!sameKind(value, spec))
        throw Error(ErrorCode::wrong_use, "option '" + key + "' must be " + typeName(spec), source);
    if (value.is_number() && !(value.get<double>() >= spec.lowest && value.get<double>() <= spec.highest)) {
        std::ostringstream range;
        range << "option '" << key << "' must lie between " << spec.lowest << " and " << spec.highest;
        throw Error(ErrorCode::wrong_use, range.str(), source);
    }
    if (value.is_string() && !spec.choices.empty() &&
        std::find(spec.choices.begin(), spec.choices.end(), value.get<std::string>()) == spec.choices.end()) {
        std::string allowed;
        for (const auto& choice : spec.choices)
            allowed += (allowed.empty() ? "" : ", ") + choice;
        throw Error(ErrorCode::wrong_use, "option '" + key + "' must be one of " + allowed, source);
    }
    if (spec.default_value.is_number_float())
        value = value.get<double>();
    values_[key] = {std::move(value), source};
}

void Config::readFile(const std::filesystem::path& file)
{
    toml::table root;
    try {
        root = toml::parse(configurationIn(file), file.string());
    } catch (const toml::parse_error& e) {
        std::ostringstream where;
        where << file.string() << ":" << e.source().begin.line;
        throw Error(ErrorCode::wrong_use, std::string(e.description()), where.str());
    }
    for (const auto& [table_name, node] : root) {
        const std::string room(table_name.str());
        const toml::table* table = node.as_table();
        std::ostringstream where;
        where << file.string() << ":" << node.source().begin.line;
        if (!table)
            throw Error(ErrorCode::wrong_use, "'" + room + "' is not a table", where.str(), "write [" + room + "]");
        for (const auto& [name, value] : *table) {
            std::ostringstream line;
            line << file.string() << ":" << value.source().begin.line;
            if (room == "peers") {
                const toml::table* peer = value.as_table();
                const bool has_host = peer && (*peer)["host"].is_string() && (*peer)["port"].is_integer();
                if (!has_host && (!peer || !peer->contains("url")))
                    throw Error(ErrorCode::wrong_use, "a peer needs host and port, or url", line.str());
                for (const auto& [field, v] : *peer)
                    peers_[std::string(name.str())][std::string(field.str())] = fromToml(v);
            } else {
                assign(room + "." + std::string(name.str()), fromToml(value), line.str());
            }
        }
    }
}

void Config::set(const std::string& assignment)
{
    const auto equals = assignment.find('=');
    if (equals == std::string::npos)
        throw Error(ErrorCode::wrong_use, "'" + assignment + "' is not key=value", "--set");
    const std::string key = assignment.substr(0, equals);
    assign(key, fromText(assignment.substr(equals + 1), specFor(key, "--set")), "command line");
}

}  // namespace vicon

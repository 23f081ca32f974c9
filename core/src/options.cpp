#include "vicon/core/options.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "vicon/core/error.h"

namespace vicon {
namespace {

std::size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row.back();
}

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
    const OptionSpec* nearest = nullptr;
    std::size_t least = 5;
    for (const OptionSpec& spec : specs_) {
        if (spec.key == key)
            return spec;
        if (const auto d = editDistance(spec.key, key); d < least) {
            least = d;
            nearest = &spec;
        }
    }
    throw Error(ErrorCode::wrong_use, "unknown option '" + key + "'", source,
                nearest ? "did you mean '" + nearest->key + "'?" : "'vicon config' lists all options");
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
        root = toml::parse_file(file.string());
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

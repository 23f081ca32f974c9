#include "describe_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

using nlohmann::json;

namespace vicon::report {
namespace {

/// More lines than these stand in scan.json only.
constexpr std::size_t kMostNotes = 6;

struct UnitSuffix {
    const char* suffix;
    const char* unit;
    double factor;
};
constexpr std::array<UnitSuffix, 8> kUnits = {{{"_mm", " mm", 1},
                                               {"_ml", " ml", 1},
                                               {"_hu", " HU", 1},
                                               {"_deg", "\u00b0", 1},
                                               {"_s", " s", 1},
                                               {"_mm3", " mm\u00b3", 1},
                                               {"_percent", " %", 1},
                                               {"_fraction", " %", 100}}};

std::string rounded(double value)
{
    std::array<char, 32> text{};
    const bool whole = std::abs(value - std::round(value)) < 1e-9 || std::abs(value) >= 100;
    std::snprintf(text.data(), text.size(), whole ? "%.0f" : std::abs(value) < 1 ? "%.2f" : "%.1f", value);
    return text.data();
}

std::string wordsOf(std::string key)
{
    std::replace(key.begin(), key.end(), '_', ' ');
    return key;
}

std::string measure(const std::string& key, const json& value)
{
    if (value.is_boolean())
        return wordsOf(key) + (value.get<bool>() ? ": yes" : ": no");
    if (value.is_string())
        return wordsOf(key) + ": " + value.get<std::string>();
    for (const UnitSuffix& unit : kUnits)
        if (key.ends_with(unit.suffix))
            return wordsOf(key.substr(0, key.size() - std::string(unit.suffix).size())) + " " +
                   rounded(unit.factor * value.get<double>()) + unit.unit;
    return wordsOf(key) + " " + rounded(value.get<double>());
}

bool isPlain(const json& value)
{
    return value.is_number() || value.is_string() || value.is_boolean();
}

/// The plain members of an object in one line.
std::string measuresInLine(const json& object)
{
    std::string line;
    for (const auto& [key, value] : object.items())
        if (isPlain(value))
            line += (line.empty() ? "" : ", ") + measure(key, value);
    return line;
}

}  // namespace

double numberAt(const json& object, const char* key)
{
    if (!object.is_object())
        return 0;
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

std::string textAt(const json& object, const char* key)
{
    if (!object.is_object())
        return {};
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

bool flagAt(const json& object, const char* key)
{
    if (!object.is_object())
        return false;
    const auto found = object.find(key);
    return found != object.end() && found->is_boolean() && found->get<bool>();
}

std::vector<std::string> describeMeasures(const json& measures)
{
    if (measures.is_string())
        return {measures.get<std::string>()};
    if (!measures.is_object())
        return {};
    std::vector<std::string> lines;
    if (std::string line = measuresInLine(measures); !line.empty())
        lines.push_back(std::move(line));
    const auto addNested = [&](const std::string& name, const json& object) {
        if (const std::string line = measuresInLine(object); !line.empty())
            lines.push_back(name.empty() ? line : name + ": " + line);
    };
    for (const auto& [key, value] : measures.items()) {
        if (value.is_object()) {
            addNested(wordsOf(key), value);
            for (const auto& [inner, nested] : value.items())
                if (nested.is_object())
                    addNested(wordsOf(inner), nested);
        }
        if (value.is_array())
            for (const json& item : value)
                if (item.is_object())
                    addNested("", item);
    }
    return lines;
}

std::vector<std::string> describeNotes(const json& notes)
{
    std::vector<std::pair<std::string, int>> counted;
    if (!notes.is_array())
        return {};
    for (const json& note : notes) {
        const std::string text = note.is_string() ? note.get<std::string>() : textAt(note, "why");
        if (text.empty())
            continue;
        const auto same = std::find_if(counted.begin(), counted.end(), [&](const auto& c) { return c.first == text; });
        if (same == counted.end())
            counted.emplace_back(text, 1);
        else
            ++same->second;
    }
    std::vector<std::string> lines;
    for (const auto& [text, count] : counted) {
        if (lines.size() == kMostNotes) {
            lines.push_back("and " + std::to_string(counted.size() - kMostNotes) + " more");
            break;
        }
        lines.push_back(count == 1 ? text : text + " (" + std::to_string(count) + " times)");
    }
    return lines;
}

std::string joinedLines(const std::vector<std::string>& lines)
{
    std::string out;
    for (const std::string& line : lines)
        out += (out.empty() ? "" : "\n") + line;
    return out;
}

}  // namespace vicon::report

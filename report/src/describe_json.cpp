#include "describe_json.h"

#include <algorithm>
#include <utility>

using nlohmann::json;

namespace vicon::report {
namespace {

/// More lines than these stand in scan.json only.
constexpr std::size_t kMostNotes = 6;

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

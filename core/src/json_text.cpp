#include "vicon/core/json_text.h"

#include <cmath>
#include <limits>

using nlohmann::json;

namespace vicon {
namespace {

/// Whether brackets stand deeper than the limit, outside of texts. What is no JSON at all is left to the parser.
bool isTooDeep(std::string_view text)
{
    int depth = 0;
    bool in_text = false;
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char c = text[n];
        if (in_text) {
            n += c == '\\' ? 1 : 0;
            in_text = c != '"';
            continue;
        }
        in_text = c == '"';
        depth += c == '[' || c == '{' ? 1 : c == ']' || c == '}' ? -1 : 0;
        if (depth > kDeepestJson)
            return true;
    }
    return false;
}

double between(double least, const json& number, double most)
{
    const auto value = number.get<double>();
    if (!(value >= least && value <= most))
        (void)number.at("a whole number");  // throws: a number has no such key
    return value;
}

}  // namespace

json parsedJson(std::string_view text)
{
    if (isTooDeep(text))
        return json(json::value_t::discarded);
    return json::parse(text.begin(), text.end(), nullptr, false);
}

int wholeNumber(const json& number)
{
    constexpr double kMost = std::numeric_limits<int>::max();
    return int(between(-kMost, number, kMost));
}

int wholeNumber(const json& from, const char* key, int missing)
{
    const auto found = from.find(key);
    return found == from.end() ? missing : wholeNumber(*found);
}

std::size_t wholeCount(const json& number)
{
    constexpr double kMost = 1LL << std::numeric_limits<double>::digits;
    return std::size_t(between(0, number, kMost));
}

}  // namespace vicon

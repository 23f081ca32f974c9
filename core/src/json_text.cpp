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

}  // namespace

json parsedJson(std::string_view text)
{
    if (isTooDeep(text))
        return json(json::value_t::discarded);
    return json::parse(text.begin(), text.end(), nullptr, false);
}

int wholeNumber(const json& number)
{
    const double value = number.get<double>();
    if (!(std::abs(value) <= double(std::numeric_limits<int>::max())))
        (void)number.at("a whole number");  // throws: a number has no such key
    return int(value);
}

}  // namespace vicon

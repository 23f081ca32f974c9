#include "vicon/core/printable.h"

#include <cstdint>
#include <cstdio>

namespace vicon {
namespace {

constexpr std::string_view kReplacement = "\uFFFD";

struct Decoded {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  ///< 0: no UTF-8
};

/// The character at the beginning of a text that is not empty. Overlong forms, surrogates and what lies beyond Unicode
/// are none.
Decoded firstOf(std::string_view text)
{
    const auto lead = std::uint8_t(text.front());
    if (lead < 0x80)
        return {lead, 1};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes)
        return {};
    std::uint32_t code = lead & (0xffu >> (bytes + 1));
    for (std::size_t n = 1; n < bytes; ++n) {
        const auto next = std::uint8_t(text[n]);
        if ((next & 0xc0) != 0x80)
            return {};
        code = code << 6 | (next & 0x3fu);
    }
    const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return overlong || surrogate || code > 0x10ffff ? Decoded{} : Decoded{code, bytes};
}

/// Whether a character acts instead of being seen.
bool acts(std::uint32_t code)
{
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029 ||
           (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

std::string escapeOf(std::uint32_t code)
{
    if (code == '\n')
        return "\\n";
    if (code == '\r')
        return "\\r";
    if (code == '\t')
        return "\\t";
    char text[16];
    std::snprintf(text, sizeof text, code < 0x80 ? "\\x%02x" : "\\u%04x", unsigned(code));
    return text;
}

}  // namespace

std::string printable(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const Decoded next = firstOf(text);
        if (next.bytes == 0)
            out += kReplacement;
        else if (acts(next.code))
            out += escapeOf(next.code);
        else
            out += text.substr(0, next.bytes);
        text.remove_prefix(next.bytes == 0 ? 1 : next.bytes);
    }
    return out;
}

std::string shortened(const std::string& text, int most_characters)
{
    int characters = 0;
    for (std::size_t n = 0; n < text.size(); ++n)
        if (const bool begins = (std::uint8_t(text[n]) & 0xC0U) != 0x80U; begins && characters++ == most_characters)
            return text.substr(0, n) + "...";
    return text;
}

}  // namespace vicon

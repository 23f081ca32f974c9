#include "text_table.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "vicon/core/printable.h"

namespace vicon::app {
namespace {

/// Characters of a UTF-8 text; continuation bytes do not count.
std::size_t width(const std::string& text)
{
    return std::size_t(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string formatTable(const std::vector<std::string>& header, std::vector<std::vector<std::string>> rows)
{
    for (std::vector<std::string>& row : rows)  // a note may hold any character
        std::transform(row.begin(), row.end(), row.begin(), printable);
    std::vector<std::size_t> widths(header.size());
    const auto widen = [&](const std::vector<std::string>& row) {
        for (std::size_t n = 0; n < row.size(); ++n)
            widths[n] = std::max(widths[n], width(row[n]));
    };
    widen(header);
    for (const auto& row : rows)
        widen(row);
    std::string out;
    const auto print = [&](const std::vector<std::string>& row) {
        std::string line;
        for (std::size_t n = 0; n < row.size(); ++n)
            line += row[n] + std::string(widths[n] - width(row[n]) + 2, ' ');
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    };
    print(header);
    for (const auto& row : rows)
        print(row);
    return out;
}

std::string formatNumber(double value, int decimals)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    const bool is_zero = std::string_view(text).find_first_not_of("-0.") == std::string_view::npos;
    return text + (is_zero && text[0] == '-' ? 1 : 0);  // nobody means minus nothing
}

}  // namespace vicon::app

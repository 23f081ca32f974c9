#include "mask/header_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>

#include "mask/refusal.h"

namespace vicon::ingest {
namespace {

// 3D Slicer writes a page about each of a hundred segments.
constexpr std::size_t kLongestHeader = 1 << 20;

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(" \t\r\n");
    return first == std::string::npos ? std::string()
                                      : text.substr(first, text.find_last_not_of(" \t\r\n") + 1 - first);
}

/// A line with its end; shorter than that where the file or what may be read ends.
std::string nextLine(std::istream& in, std::size_t most)
{
    std::string line;
    for (int letter = 0; line.size() < most && (letter = in.get()) != std::istream::traits_type::eof();) {
        line.push_back(char(letter));
        if (letter == '\n')
            break;
    }
    return line;
}

}  // namespace

HeaderText readHeaderText(const std::filesystem::path& file, std::string_view sign,
                          const std::function<bool(const std::string& name)>& isLast)
{
    std::ifstream in(file, std::ios::binary);
    HeaderText header;
    while (header.bytes < kLongestHeader) {
        const std::string line = nextLine(in, kLongestHeader - header.bytes);
        if (!line.ends_with('\n'))
            break;
        header.bytes += line.size();
        if (line.starts_with('#'))
            continue;
        const std::size_t at = line.find(sign);
        const std::string name = at == std::string::npos ? "" : lowerCase(trimmed(line.substr(0, at)));
        const std::string value = trimmed(at == std::string::npos ? line : line.substr(at + sign.size()));
        if (!name.empty() && !header.fields.emplace(name, value).second)
            throw maskRefused(file, "its header says something twice: " + shown(name), "write the mask again");
        if (isLast(name.empty() ? value : name))
            return header;
    }
    throw maskRefused(file, "its header has no end", "write the mask again");
}

std::optional<std::vector<double>> numbersIn(const std::string& text)
{
    std::vector<double> numbers;
    for (const char *at = text.data(), *end = at + text.size(); at != end;) {
        if (*at == ' ' || *at == ',' || *at == '(' || *at == ')' || *at == '\t') {
            ++at;
            continue;
        }
        double number = 0;
        const auto read = std::from_chars(at, end, number);
        if (read.ec != std::errc())
            return std::nullopt;
        numbers.push_back(number);
        at = read.ptr;
    }
    return numbers;
}

std::optional<std::vector<double>> numbersIn(const std::string& text, std::size_t count)
{
    auto numbers = numbersIn(text);
    return numbers && numbers->size() == count ? numbers : std::nullopt;
}

std::string lowerCase(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

}  // namespace vicon::ingest

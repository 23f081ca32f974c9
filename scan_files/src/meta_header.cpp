#include "meta_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <utility>

#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

constexpr const char* kVoxelsFollow = "ElementDataFile = LOCAL\n";
/// Zlib packs no better.
constexpr std::size_t kBestPacking = 1032;

constexpr std::size_t kLongestLine = 300;  // of a header, with its end
constexpr const char* kMakeAnew = "run 'vicon work' to make it anew";

std::string line(const char* key, std::initializer_list<double> numbers)
{
    std::string text = std::string(key) + " =";
    for (const double number : numbers) {
        char word[32];
        std::snprintf(word, sizeof word, " %.17g", number);
        text += word;
    }
    return text + "\n";
}

/// One line of a header, "Name = value".
struct Field {
    std::string name, value;
};

/// Nothing where a line is none, or is longer than MetaIO has room for: it copies without asking.
std::optional<Field> fieldIn(const std::string& line)
{
    constexpr std::size_t kLongestName = 40, kLongestValue = 250;
    static_assert(kLongestLine > kLongestName + 3 + kLongestValue);
    const std::size_t sign = line.find(" = ");
    if (sign == std::string::npos || sign == 0 || sign > kLongestName || line.size() > sign + 3 + kLongestValue)
        return std::nullopt;
    const auto isNameLetter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
    const auto isPrinted = [](char c) { return c >= ' ' && c <= '~'; };
    if (!std::all_of(line.begin(), line.begin() + std::ptrdiff_t(sign), isNameLetter) ||
        !std::all_of(line.begin(), line.end(), isPrinted))
        return std::nullopt;
    return Field{line.substr(0, sign), line.substr(sign + 3)};
}

struct Header {
    bool says(const std::string& name, const std::string& value) const
    {
        const auto field = said.find(name);
        return field != said.end() && field->second == value;
    }
    bool saysOrIsSilent(const std::string& name, const std::string& value) const
    {
        return !said.contains(name) || says(name, value);
    }

    std::map<std::string, std::string> said;
    std::size_t end = 0;  // where the voxels begin
};

/// Nothing where a line is none, something is said twice, or the voxels do not follow in the file.
std::optional<Header> headerIn(const fs::path& file)
{
    constexpr std::size_t kMostFields = 40;
    std::ifstream in(file, std::ios::binary);
    Header header;
    std::array<char, kLongestLine> line{};
    while (header.said.size() < kMostFields && in.getline(line.data(), line.size())) {
        header.end += std::size_t(in.gcount());
        const std::optional<Field> field = fieldIn(std::string(line.data(), std::size_t(in.gcount() - 1)));
        if (!field || !header.said.emplace(field->name, field->value).second)
            return std::nullopt;
        if (field->name == "ElementDataFile")
            return field->value == "LOCAL" ? std::optional(std::move(header)) : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

std::string rawHeader(const Grid& grid, const std::string& type)
{
    const auto& [x, y, z] = grid.axis;
    const std::string lines = "BinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n" +
                              line("TransformMatrix", {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}) +
                              line("Offset", {grid.origin_mm.x, grid.origin_mm.y, grid.origin_mm.z}) +
                              "CenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\n" +
                              line("ElementSpacing", {grid.spacing_mm[0], grid.spacing_mm[1], grid.spacing_mm[2]}) +
                              line("DimSize", {double(grid.size[0]), double(grid.size[1]), double(grid.size[2])}) +
                              "ElementType = " + type + "\n" + kVoxelsFollow;
    const std::string first = "ObjectType = Image\nNDims = 3\nComment = voxels are aligned ";
    const std::size_t least = first.size() + 1 + lines.size();
    const std::size_t missing = (kVoxelAlignment - least % kVoxelAlignment) % kVoxelAlignment;
    return first + std::string(missing, '.') + "\n" + lines;
}

bool isPlainHeader(const fs::path& file)
{
    const std::optional<Header> header = headerIn(file);
    return header && header->says("NDims", "3") && header->says("BinaryData", "True") &&
           header->saysOrIsSilent("BinaryDataByteOrderMSB", "False") &&
           header->saysOrIsSilent("ElementByteOrderMSB", "False") && !header->said.contains("HeaderSize") &&
           (header->saysOrIsSilent("CompressedData", "False") || header->says("CompressedData", "True"));
}

VoxelBytes voxelBytesIn(const fs::path& file, std::size_t raw_bytes)
{
    const std::optional<Header> header = headerIn(file);
    if (!header)
        throw Error(ErrorCode::bad_input, "does not hold its voxels itself", file.string(), kMakeAnew);
    VoxelBytes bytes{header->end, raw_bytes, header->says("CompressedData", "True")};
    if (bytes.packed) {
        const auto size = header->said.find("CompressedDataSize");
        const std::string digits = size == header->said.end() ? "" : size->second;
        if (std::from_chars(digits.data(), digits.data() + digits.size(), bytes.count).ec != std::errc())
            throw Error(ErrorCode::bad_input, "does not say how many bytes its voxels are", file.string(), kMakeAnew);
    }
    const std::uintmax_t size = fs::file_size(file), left = size - std::min<std::uintmax_t>(size, bytes.begin);
    if (left < bytes.count || left < raw_bytes / kBestPacking)
        throw Error(ErrorCode::bad_input, "is cut off", file.string(), kMakeAnew);
    return bytes;
}

}  // namespace vicon::scan_files

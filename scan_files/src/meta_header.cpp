#include "meta_header.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <string_view>

#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::scan_files {
namespace {

constexpr const char* kVoxelsFollow = "ElementDataFile = LOCAL\n";
/// Zlib packs no better.
constexpr std::size_t kBestPacking = 1032;

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

/// Whether a name stands in a header, before `end`, and each time with that value.
bool saysEachTime(std::string_view head, std::string_view name, std::string_view value, std::size_t end)
{
    constexpr std::string_view kBetween = " \t=:", kEnds = " \t\r\n";
    bool said = false;
    for (std::size_t at = head.find(name); at < end; at = head.find(name, at + 1)) {
        const std::size_t from = head.find_first_not_of(kBetween, at + name.size());
        if (from == std::string_view::npos || head.substr(from, value.size()) != value)
            return false;
        const std::size_t behind = from + value.size();
        if (behind >= head.size() || kEnds.find(head[behind]) == std::string_view::npos)
            return false;
        said = true;
    }
    return said;
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

bool saysThreeDimensionsInOneFile(const fs::path& file)
{
    constexpr std::size_t kLongestHeader = 65536;
    constexpr std::string_view kLast = "ElementDataFile";
    std::string head(kLongestHeader, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(in.gcount()));
    return saysEachTime(head, "NDims", "3", head.find(kLast)) && saysEachTime(head, kLast, "LOCAL", head.size());
}

VoxelBytes voxelBytesIn(const fs::path& file, std::size_t raw_bytes)
{
    std::string head(4096, '\0');
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(in.gcount()));
    const auto local = head.find(kVoxelsFollow);
    if (local == std::string::npos)
        throw Error(ErrorCode::bad_input, "does not hold its voxels itself", file.string(), kMakeAnew);
    VoxelBytes bytes{local + std::char_traits<char>::length(kVoxelsFollow), raw_bytes, false};
    const std::string key = "CompressedDataSize = ";
    if (const auto at = head.find(key); at < local) {
        bytes.packed = true;
        const auto read = std::from_chars(head.data() + at + key.size(), head.data() + head.size(), bytes.count);
        if (read.ec != std::errc())
            throw Error(ErrorCode::bad_input, "does not say how many bytes its voxels are", file.string(), kMakeAnew);
    }
    const std::uintmax_t size = fs::file_size(file), left = size - std::min<std::uintmax_t>(size, bytes.begin);
    if (left < bytes.count || left < raw_bytes / kBestPacking)
        throw Error(ErrorCode::bad_input, "is cut off", file.string(), kMakeAnew);
    return bytes;
}

}  // namespace vicon::scan_files

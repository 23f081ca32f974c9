#include "study_key.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <span>
#include <string_view>

namespace vicon::ingest {
namespace {

/// The identifying groups of a header lie well within it.
constexpr std::size_t kLooked = 65536;
constexpr std::size_t kLongestUid = 64;
/// Little and big endian.
constexpr std::string_view kClass[] = {{"\x08\x00\x16\x00", 4}, {"\x00\x08\x00\x16", 4}};
constexpr std::string_view kObject[] = {{"\x08\x00\x18\x00", 4}, {"\x00\x08\x00\x18", 4}};
constexpr std::string_view kStudy[] = {{"\x20\x00\x0D\x00", 4}, {"\x00\x20\x00\x0D", 4}};
constexpr std::string_view kSeries[] = {{"\x20\x00\x0E\x00", 4}, {"\x00\x20\x00\x0E", 4}};

std::string beginningOf(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::string bytes(kLooked, '\0');
    in.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(in.gcount()));
    return bytes;
}

/// The UID whose element begins at `at`; empty when no UID follows.
std::string uidAt(std::string_view bytes, std::size_t at)
{
    constexpr std::size_t kHead = 8;  // tag, then VR and a short length, or a long length
    if (at + kHead >= bytes.size())
        return {};
    std::string uid(bytes.substr(at + kHead, kLongestUid));
    uid.resize(std::min(uid.find_first_not_of("0123456789."), uid.size()));
    return uid;
}

std::string uidOf(std::string_view bytes, std::span<const std::string_view> tags)
{
    for (const std::string_view tag : tags)
        if (const std::size_t at = bytes.find(tag); at != std::string::npos)
            if (std::string uid = uidAt(bytes, at); !uid.empty())
                return uid;
    return {};
}

}  // namespace

ObjectUids uidsOf(const std::filesystem::path& file)
{
    const std::string bytes = beginningOf(file);
    return {uidOf(bytes, kStudy), uidOf(bytes, kSeries), uidOf(bytes, kObject), uidOf(bytes, kClass)};
}

}  // namespace vicon::ingest

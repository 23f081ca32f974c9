#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace vicon::ingest {

/// How elements stand in a stream (PS3.5, 7 and A): what those need that look at it before a DICOM library does.
/// @{
inline constexpr std::uint32_t kUndefinedLength = 0xffffffff;
/// Where a sequence or item ends that does not say its length.
inline constexpr std::uint64_t kOpenEnd = ~std::uint64_t(0);
inline constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
inline constexpr std::uint32_t kDelimiterGroup = 0xfffe;
inline constexpr std::uint32_t kRecordType = 0x00041430;
/// PS3.5 6.2, CS. Of a longer type of a directory record DCMTK's parser throws, and loses what it has read.
inline constexpr std::uint32_t kLongestCode = 16;

/// The types whose length has two bytes, and those with four.
inline constexpr std::string_view kShortVrs = "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US ";
inline constexpr std::string_view kLongVrs = "OB OD OF OL OV OW SQ SV UC UN UR UT UV ";

inline bool isTypeOf(std::string_view vrs, std::string_view vr)
{
    const std::size_t at = vrs.find(vr);
    return at != std::string_view::npos && at % 3 == 0;
}

struct Coding {
    bool explicit_vr = true, big_endian = false;
};

/// How DCMTK reads a data set of this transfer syntax, a UID; nothing where it unpacks it first. Nor of what it knows
/// by another text, or not at all: it would take away spaces, look among names, and guess by the first element.
std::optional<Coding> codingOf(const std::string& transfer_syntax);
bool isDeflated(const std::string& transfer_syntax);

/// Whether DCMTK may read a value of which no type is written as a sequence, though it does not begin as one: the
/// dictionary says so, or nobody knows. A sequence that ends before its length does, or is shorter than the head of an
/// item, leaves DCMTK elsewhere in the file than where the length leads.
/// @param begin the value's first bytes, at most eight
bool mayEndElsewhere(std::uint32_t tag, const unsigned char* begin, std::size_t count);

/// A number of so many bytes.
inline std::uint32_t numberIn(const unsigned char* bytes, std::size_t count, bool big_endian)
{
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < count; ++n)
        value = value << 8 | bytes[big_endian ? n : count - 1 - n];
    return value;
}

/// Group and element, the group in the upper half.
inline std::uint32_t tagIn(const unsigned char* bytes, bool big_endian)
{
    return numberIn(bytes, 2, big_endian) << 16 | numberIn(bytes + 2, 2, big_endian);
}

inline std::string tagName(std::uint32_t tag)
{
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "(%04x,%04x)", unsigned(tag >> 16), unsigned(tag & 0xffff));
    return text.data();
}
/// @}

}  // namespace vicon::ingest

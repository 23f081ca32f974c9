#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
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
inline constexpr std::string_view kImplicitLittleEndian = "1.2.840.10008.1.2",
                                  kExplicitBigEndian = "1.2.840.10008.1.2.2",
                                  kDeflatedLittleEndian = "1.2.840.10008.1.2.1.99";

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

inline Coding codingOf(std::string_view transfer_syntax)
{
    return {transfer_syntax != kImplicitLittleEndian, transfer_syntax == kExplicitBigEndian};
}

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

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "image_object.h"

namespace vicon::ingest {

/// What VICON asks its decoder program, over a socket that is the program's standard input. Both are of one build, so
/// these are plain bytes of memory. The payload follows.
struct HelperRequest {
    enum class Kind : std::uint32_t {
        decode,  ///< payload: one compressed frame; answer: its pixels
        read,    ///< a descriptor of a file comes along; answer: nothing, when the file was read without harm
    };
    Kind kind = Kind::decode;
    std::uint32_t cpu_seconds = 1;  ///< after these the program is ended
    std::int32_t rows = 0, columns = 0, bits_allocated = 0, bits_stored = 0, high_bit = 0, is_signed = 0;
    char transfer_syntax[72] = {};
    std::uint64_t bytes = 0;  ///< of the payload
};

struct HelperAnswer {
    enum class Fate : std::uint32_t { done, failed };
    Fate fate = Fate::failed;
    std::uint64_t bytes = 0;  ///< of the payload: the pixels, or why it failed
};
static_assert(std::is_trivially_copyable_v<HelperRequest> && std::is_trivially_copyable_v<HelperAnswer>);

HelperRequest decodeRequest(const PixelFormat& format, const std::string& transfer_syntax, std::size_t stream_bytes);
PixelFormat pixelFormatOf(const HelperRequest& request);

/// The largest stream that is decoded: the most that a frame can hold, and headers.
inline constexpr std::uint64_t kLargestStream = std::uint64_t(1) << 30;
/// The program's exit code where it could not be kept from files, the network and other programs: it decodes nothing.
inline constexpr int kNotConfined = 3;
/// Words of a failure are cut to this.
inline constexpr std::size_t kLongestReason = 500;

}  // namespace vicon::ingest

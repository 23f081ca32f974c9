#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace vicon::steps {

/// Eight bytes at once.
inline std::uint64_t eightOf(const std::uint8_t* bytes)
{
    std::uint64_t eight;
    std::memcpy(&eight, bytes, sizeof eight);
    return eight;
}

/// Number of the first of bytes [n, end) that is not `value`, or `end`. Most of a volume around a lumen is the same.
template <class Number>
Number firstOther(const std::uint8_t* bytes, Number n, Number end, std::uint8_t value)
{
    const std::uint64_t eight = value * (~std::uint64_t(0) / 255);
    while (n + 8 <= end && eightOf(bytes + n) == eight)
        n += 8;
    while (n < end && bytes[n] == value)
        ++n;
    return n;
}

}  // namespace vicon::steps

#pragma once

#include <algorithm>
#include <cstdint>

namespace vicon::viewer {

/// Float4 numbers that the processor treats at once: a place or a way along a grid's three axes (the last number is 0),
/// or one number of each corner of a square. Single precision: off by some 1e-4 where numbers reach a thousand.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 leastOf(Float4 a, Float4 b)
{
    return a < b ? a : b;
}
inline Float4 mostOf(Float4 a, Float4 b)
{
    return a > b ? a : b;
}
inline float leastIn(Float4 a)
{
    return std::min(std::min(a[0], a[1]), std::min(a[2], a[3]));
}
inline float mostIn(Float4 a)
{
    return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

inline Float4 toFloat4(Int4 a)
{
    return __builtin_convertvector(a, Float4);
}
/// The next whole numbers below. Not std::floor, which is a call or a dozen instructions a number where the processor
/// may lack those for rounding.
inline Int4 floorOf(Float4 a)
{
    const Int4 cut = __builtin_convertvector(a, Int4);  // towards 0
    return cut + (toFloat4(cut) > a);                   // what holds is -1
}

/// Of numbers that are 0 or -1, as comparisons make them.
inline bool allOf(Int4 a)
{
    const Int4 both = a & __builtin_shufflevector(a, a, 2, 3, 0, 1);
    return (both[0] & both[1]) != 0;
}

}  // namespace vicon::viewer

#pragma once

#include <algorithm>
#include <cstdint>

namespace vicon::viewer {

/// Four numbers that the processor treats at once: a place or a way along a grid's three axes (the last number is 0),
/// or one number of each corner of a square. Single precision: off by some 1e-4 where numbers reach a thousand.
using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

inline Four leastOf(Four a, Four b)
{
    return a < b ? a : b;
}
inline Four mostOf(Four a, Four b)
{
    return a > b ? a : b;
}
inline float leastIn(Four a)
{
    return std::min(std::min(a[0], a[1]), std::min(a[2], a[3]));
}
inline float mostIn(Four a)
{
    return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

inline Four fourOf(FourInts a)
{
    return __builtin_convertvector(a, Four);
}
/// The next whole numbers below. Not std::floor, which is a call or a dozen instructions a number where the processor
/// may lack those for rounding.
inline FourInts floorOf(Four a)
{
    const FourInts cut = __builtin_convertvector(a, FourInts);  // towards 0
    return cut + (fourOf(cut) > a);                             // what holds is -1
}

/// Of numbers that are 0 or -1, as comparisons make them.
inline bool allOf(FourInts a)
{
    const FourInts both = a & __builtin_shufflevector(a, a, 2, 3, 0, 1);
    return (both[0] & both[1]) != 0;
}

}  // namespace vicon::viewer

#include "topology.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <bit>
#include <functional>

namespace vicon::phantom {
namespace {

/// What a block of 2 x 2 x 2 voxels adds to eight times the Euler number of a union of closed cubes: the corner that
/// the block shares, half of its edges' shares and so on (Gray 1971).
std::array<int, 256> contributions()
{
    std::array<int, 256> table{};
    for (int block = 0; block < 256; ++block) {
        const auto any = [block](int mask) { return (block & mask) != 0; };
        int edges = 0, faces = 0;
        for (const int mask : {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0})
            edges += any(mask);  // the four voxels around an edge: each edge is seen from its two ends
        for (int a = 0; a < 8; ++a)
            for (int b = a + 1; b < 8; ++b)
                if (std::has_single_bit(unsigned(a ^ b)))
                    faces += any((1 << a) | (1 << b));  // the two beside a face, seen from its four corners
        table[std::size_t(block)] = 8 * any(block) - 4 * edges + 2 * faces - std::popcount(unsigned(block));
    }
    return table;
}

/// The same for voxels as points, joined to their face neighbours by edges, squares and cubes where all corners are
/// set.
std::array<int, 256> contributionsOfFaces()
{
    std::array<int, 256> table{};
    for (int block = 0; block < 256; ++block) {
        const auto all = [block](int mask) { return (block & mask) == mask; };
        int edges = 0, squares = 0;
        for (const int mask : {0x55, 0xaa, 0x33, 0xcc, 0x0f, 0xf0})
            squares += all(mask);
        for (int a = 0; a < 8; ++a)
            for (int b = a + 1; b < 8; ++b)
                if (std::has_single_bit(unsigned(a ^ b)))
                    edges += all((1 << a) | (1 << b));
        table[std::size_t(block)] = std::popcount(unsigned(block)) - 2 * edges + 4 * squares - 8 * all(0xff);
    }
    return table;
}

/// Adds up what the blocks of 2 x 2 x 2 voxels contribute, those over the rim included.
int sumOverBlocks(const InsideVolume& volume, Index3 low, std::array<int, 3> size, const std::array<int, 256>& table)
{
    const auto inside = [&](int i, int j, int k) {
        return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2] &&
               volume.at({low.i + i, low.j + j, low.k + k}) != kOutside;
    };
    const long sum = tbb::parallel_reduce(
        tbb::blocked_range<int>(0, size[2] + 1), 0L,
        [&](const tbb::blocked_range<int>& range, long part) {
            for (int k = range.begin(); k < range.end(); ++k)
                for (int j = 0; j <= size[1]; ++j) {
                    int block = 0;
                    for (int i = 0; i <= size[0]; ++i) {
                        block = (block >> 1) & 0x55;
                        for (int d = 0; d < 4; ++d)
                            block |= inside(i, j - 1 + (d & 1), k - 1 + (d >> 1)) << (2 * d + 1);
                        part += table[std::size_t(block)];
                    }
                }
            return part;
        },
        std::plus<>());
    return int(sum / 8);
}

}  // namespace

int eulerNumber26(const InsideVolume& volume, Index3 low, std::array<int, 3> size)
{
    return sumOverBlocks(volume, low, size, contributions());
}

int eulerNumber6(const InsideVolume& volume, Index3 low, std::array<int, 3> size)
{
    return sumOverBlocks(volume, low, size, contributionsOfFaces());
}

}  // namespace vicon::phantom

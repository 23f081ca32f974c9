#include "topology.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <bit>
#include <cstdlib>
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

struct EulerNumbers {
    int as26 = 0, as6 = 0;
    int touching = 0;  ///< blocks in which the two differ

    int misses(int wanted) const { return std::abs(as26 - wanted) + std::abs(as6 - wanted); }
};

/// What the eight blocks around a voxel contribute, times eight.
EulerNumbers around(const InsideVolume& volume, Index3 v)
{
    static const std::array<int, 256> table26 = contributions(), table6 = contributionsOfFaces();
    EulerNumbers sum;
    for (int corner = 0; corner < 8; ++corner) {
        std::size_t block = 0;
        for (int n = 0; n < 8; ++n) {
            const Index3 at{v.i - (corner & 1) + (n & 1), v.j - ((corner >> 1) & 1) + ((n >> 1) & 1),
                            v.k - (corner >> 2) + (n >> 2)};
            block |= std::size_t(volume.valueOr(at, kOutside) != kOutside) << n;
        }
        sum.as26 += table26[block];
        sum.as6 += table6[block];
        sum.touching += table26[block] != table6[block];
    }
    return sum;
}

/// Takes a voxel out, or puts it in, if that helps.
bool isChanged(InsideVolume& volume, Index3 v, std::uint8_t to, int wanted, EulerNumbers& all)
{
    const EulerNumbers before = around(volume, v);
    if (before.touching == 0)
        return false;
    const std::uint8_t was = volume.at(v);
    volume.at(v) = to;
    const EulerNumbers after = around(volume, v);
    const EulerNumbers changed{all.as26 + (after.as26 - before.as26) / 8, all.as6 + (after.as6 - before.as6) / 8};
    if (after.touching < before.touching && changed.misses(wanted) <= all.misses(wanted)) {
        all = changed;
        return true;
    }
    volume.at(v) = was;
    return false;
}

/// All that help, of those that are in the lumen, or of those that are not.
std::vector<Index3> changedAtCorners(InsideVolume& volume, Index3 low, std::array<int, 3> size, bool put_in, int wanted)
{
    const std::uint8_t to = put_in ? kGas : kOutside;
    EulerNumbers all{eulerNumber26(volume, low, size), eulerNumber6(volume, low, size)};
    std::vector<Index3> changed;
    for (int k = low.k; k < low.k + size[2]; ++k)
        for (int j = low.j; j < low.j + size[1]; ++j)
            for (int i = low.i; i < low.i + size[0] && all.misses(wanted) > 0; ++i)
                if ((volume.at({i, j, k}) == kOutside) == put_in && isChanged(volume, {i, j, k}, to, wanted, all))
                    changed.push_back({i, j, k});
    return changed;
}

void emptyPiece(InsideVolume& volume, Index3 first)
{
    std::vector<Index3> todo{first};
    volume.at(first) = kOutside;
    while (!todo.empty()) {
        const Index3 v = todo.back();
        todo.pop_back();
        for (const Index3 w : {Index3{v.i - 1, v.j, v.k}, Index3{v.i + 1, v.j, v.k}, Index3{v.i, v.j - 1, v.k},
                               Index3{v.i, v.j + 1, v.k}, Index3{v.i, v.j, v.k - 1}, Index3{v.i, v.j, v.k + 1}})
            if (volume.valueOr(w, kOutside) != kOutside) {
                volume.at(w) = kOutside;
                todo.push_back(w);
            }
    }
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

std::vector<Index3> partAtCorners(InsideVolume& volume, Index3 low, std::array<int, 3> size, int wanted)
{
    return changedAtCorners(volume, low, size, false, wanted);
}

std::vector<Index3> fillAtCorners(InsideVolume& volume, Index3 low, std::array<int, 3> size, int wanted)
{
    return changedAtCorners(volume, low, size, true, wanted);
}

int countPieces(InsideVolume volume)
{
    int count = 0;
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        if (volume.voxels[n] != kOutside) {
            ++count;
            emptyPiece(volume, volume.grid.indexOf(n));
        }
    return count;
}

}  // namespace vicon::phantom

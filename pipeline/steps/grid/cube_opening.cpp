#include "grid/cube_opening.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace vicon::steps {
namespace {

constexpr std::size_t kPart = 1 << 15;  // bytes of a slice that one core takes through all slices

/// Of `count` values: each with the one `apart` behind it, where there is one; first to last.
void erode(std::uint8_t* at, std::size_t count, std::size_t apart)
{
    for (std::size_t n = 0; n < count; ++n)
        at[n] &= at[n + apart];
}

/// Each of the last `count` of count + apart values with the one `apart` before it; last to first.
void dilate(std::uint8_t* at, std::size_t count, std::size_t apart)
{
    for (std::size_t n = count; n-- > 0;)
        at[n + apart] |= at[n];
}

}  // namespace

// Both halves of the opening go along one axis after the other. The first corner of each cube is what the erosion
// leaves; the last voxel of an axis is none, and the dilation fills it again.
void openByCubes(Volume<std::uint8_t>& voxels)
{
    const auto nx = std::size_t(voxels.grid.size[0]), ny = std::size_t(voxels.grid.size[1]),
               nz = std::size_t(voxels.grid.size[2]), slice = nx * ny;
    if (slice * nz == 0)
        return;
    std::uint8_t* const all = voxels.voxels.data();
    tbb::parallel_for(std::size_t(0), nz, [&](std::size_t k) {
        std::uint8_t* const at = all + k * slice;
        for (std::size_t j = 0; j < ny; ++j) {
            erode(at + j * nx, nx - 1, 1);
            at[j * nx + nx - 1] = 0;
        }
        erode(at, slice - nx, nx);
        std::fill_n(at + slice - nx, nx, std::uint8_t(0));
    });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, slice, kPart), [&](const auto& part) {
        const std::size_t count = part.size();
        std::uint8_t* const first = all + part.begin();
        for (std::size_t k = 0; k + 1 < nz; ++k)
            erode(first + k * slice, count, slice);
        std::fill_n(first + (nz - 1) * slice, count, std::uint8_t(0));
        for (std::size_t k = nz - 1; k > 0; --k)
            dilate(first + (k - 1) * slice, count, slice);
    });
    tbb::parallel_for(std::size_t(0), nz, [&](std::size_t k) {
        std::uint8_t* const at = all + k * slice;
        dilate(at, slice - nx, nx);
        for (std::size_t j = 0; j < ny; ++j)
            dilate(at + j * nx, nx - 1, 1);
    });
}

}  // namespace vicon::steps

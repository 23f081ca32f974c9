#include "volume_writer.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "vicon/core/error.h"
#include "vicon/core/fresh_memory.h"

namespace vicon::ingest {

VolumeWriter::VolumeWriter(const StackPlan& plan) : size_(plan.grid.size)
{
    const NearestToPatient nearest = nearestToPatient(plan.grid);
    try {
        volume_.grid = nearest.grid;
        fillFresh(volume_.voxels, nearest.grid.voxelCount(), kPaddingHu);
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::no_memory,
                    "the scan's densities need " + std::to_string(plan.grid.voxelCount() * 2 / 1000000) + " MB", {},
                    "close other programs, or process this scan on a machine with more memory");
    }
    std::array<std::ptrdiff_t, 3> new_stride{1, nearest.grid.size[0],
                                             std::ptrdiff_t(nearest.grid.size[0]) * nearest.grid.size[1]};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto old = std::size_t(nearest.from[a]);
        stride_[old] = nearest.flipped[a] ? -new_stride[a] : new_stride[a];
        if (nearest.flipped[a])
            first_ += new_stride[a] * (nearest.grid.size[a] - 1);
    }
}

std::int16_t VolumeWriter::blend(std::int16_t below, std::int16_t above, double part_above)
{
    if (below == kPaddingHu || above == kPaddingHu)
        return part_above < 0.5 ? below : above;
    return std::int16_t(std::lround(below + (above - below) * part_above));
}

std::vector<std::int16_t> VolumeWriter::inPlane(const std::vector<std::int16_t>& pixels, int columns, int rows,
                                                const std::array<double, 2>& shift_pixels) const
{
    const int nx = size_[0], ny = size_[1];
    if (nx == columns && ny == rows && shift_pixels[0] == 0 && shift_pixels[1] == 0)
        return pixels;
    std::vector<std::int16_t> out(std::size_t(nx) * std::size_t(ny), kPaddingHu);
    const int whole_x = int(std::floor(shift_pixels[0])), whole_y = int(std::floor(shift_pixels[1]));
    // Output pixel i shows the slice at i - shift: between its pixels i - whole - 1 and i - whole.
    const double part_x = 1 - (shift_pixels[0] - whole_x), part_y = 1 - (shift_pixels[1] - whole_y);
    const auto at = [&](int x, int y) {
        return x < 0 || y < 0 || x >= columns || y >= rows
                   ? kPaddingHu
                   : pixels[std::size_t(y) * std::size_t(columns) + std::size_t(x)];
    };
    const auto along_row = [&](int x, int y) { return part_x == 1 ? at(x, y) : blend(at(x - 1, y), at(x, y), part_x); };
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const int x = i - whole_x, y = j - whole_y;
            out[std::size_t(j) * std::size_t(nx) + std::size_t(i)] =
                part_y == 1 ? along_row(x, y) : blend(along_row(x, y - 1), along_row(x, y), part_y);
        }
    return out;
}

void VolumeWriter::put(int k, const std::vector<std::int16_t>& plane)
{
    const auto nx = std::size_t(size_[0]);
    for (int j = 0; j < size_[1]; ++j) {
        const std::int16_t* from = plane.data() + std::size_t(j) * nx;
        std::int16_t* to = volume_.voxels.data() + first_ + k * stride_[2] + j * stride_[1];
        if (stride_[0] == 1)
            std::copy_n(from, nx, to);
        else
            for (std::size_t i = 0; i < nx; ++i)
                to[std::ptrdiff_t(i) * stride_[0]] = from[i];
    }
}

}  // namespace vicon::ingest

#pragma once

#include <unistd.h>

#include <new>
#include <stdexcept>
#include <string>

#include "vicon/core/error.h"
#include "vicon/core/fresh_memory.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// A volume of that grid, or Error{no_memory}. What is larger than the machine's memory is refused before it is asked
/// for: Linux would promise it, and kill the process when it is used.
template <class T>
Volume<T> makeVolume(const Grid& grid, T fill = T{})
{
    const double bytes = double(grid.size[0]) * double(grid.size[1]) * double(grid.size[2]) * double(sizeof(T));
    const double machine = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
    try {
        if (bytes < machine) {
            Volume<T> volume;
            volume.grid = grid;
            fillFresh(volume.voxels, grid.voxelCount(), fill);
            return volume;
        }
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    throw Error(ErrorCode::no_memory,
                "a volume of " + std::to_string(grid.size[0]) + " x " + std::to_string(grid.size[1]) + " x " +
                    std::to_string(grid.size[2]) + " voxels does not fit into memory",
                {}, "use a machine with more memory, or set resample.spacing_mm to a larger spacing");
}

}  // namespace vicon::steps

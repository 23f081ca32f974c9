#pragma once

#include <cstddef>
#include <optional>

namespace vicon::pipeline {

/// What limits the memory of this process, in bytes from now on; nothing where no limit is known.
struct MemoryLimits {
    std::optional<double> addresses;  ///< the limit of the address space (ulimit -v) less what is mapped
    std::optional<double> available;  ///< what the machine can give without swapping
};
MemoryLimits memoryLimits();

/// Throws Error{no_memory}, which says how much is needed and how much there is, when the steps of a scan cannot fit.
/// Asked before a scan is begun: libraries end the process where memory fails inside them.
/// @param voxels of the isotropic volume
/// @param most_mb what the configuration allows, MB of 10^6 bytes; 0: no limit of its own
void requireMemory(double voxels, double most_mb, const MemoryLimits& limits = memoryLimits());

/// What the steps of a scan take at their peak, MB of 10^6 bytes.
double expectedMemory_mb(double voxels);

/// What all workers of this machine may take: as configured, or four fifths of what it has.
double machineMemory_mb(double configured_mb);

}  // namespace vicon::pipeline

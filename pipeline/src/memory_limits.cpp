#include "memory_limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "vicon/core/error.h"

namespace vicon::pipeline {
namespace {

constexpr double kMega = 1e6;
// Least resident set of the steps, docs/evaluation/time-and-memory.md: 4.6 bytes a voxel where the colon is small, 8
// where it is large, and what libraries and tables take in a scan of no size. The least counts: who has it is not
// refused.
constexpr double kMostPerVoxel_bytes = 8;
constexpr double kShareOfMachine = 0.8;
constexpr double kResident_bytes = 60 * kMega, kResidentPerVoxel_bytes = 4.6;
// Address space is also taken by what is never touched: stacks and arenas of threads. Measured on the 160 x 160 x 134
// phantom: the work ends in a plain error from 200 MB of free addresses on, and succeeds from 400 MB on.
constexpr double kAddresses_bytes = 256 * kMega, kAddressesPerVoxel_bytes = 8;

std::string megabytes(double bytes)
{
    return std::to_string(std::lround(bytes / kMega)) + " MB";
}

void require(double needed, double there, const char* what, const char* remedy)
{
    if (there < needed)
        throw Error(ErrorCode::no_memory,
                    "the scan needs about " + megabytes(needed) + " of memory, and " + what + " " +
                        megabytes(std::max(0.0, there)),
                    {}, remedy);
}

}  // namespace

MemoryLimits memoryLimits()
{
    MemoryLimits limits;
    rlimit limit{};
    std::ifstream pages("/proc/self/statm");
    double mapped_pages = 0;
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY && pages >> mapped_pages)
        limits.addresses = double(limit.rlim_cur) - mapped_pages * double(::sysconf(_SC_PAGESIZE));
    std::ifstream meminfo("/proc/meminfo");
    for (std::string line; std::getline(meminfo, line);)
        if (line.starts_with("MemAvailable:"))
            limits.available = std::stod(line.substr(line.find(':') + 1)) * 1024;
    return limits;
}

double expectedMemory_mb(double voxels)
{
    return (kResident_bytes + kMostPerVoxel_bytes * voxels) / kMega;
}

double machineMemory_mb(double configured_mb)
{
    if (configured_mb > 0)
        return configured_mb;
    return kShareOfMachine * double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE)) / kMega;
}

void requireMemory(double voxels, double most_mb, const MemoryLimits& limits)
{
    const double resident = kResident_bytes + kResidentPerVoxel_bytes * voxels;
    const char* free_some = "close other programs, use a machine with more memory, or raise resample.spacing_mm";
    if (most_mb > 0)
        require(resident, most_mb * kMega, "work.memory_mb allows", "raise work.memory_mb or resample.spacing_mm");
    if (limits.available)
        require(resident, *limits.available, "the machine has", free_some);
    if (limits.addresses)
        require(kAddresses_bytes + kAddressesPerVoxel_bytes * voxels, *limits.addresses,
                "the limit of this process (ulimit -v) leaves", "raise the limit, or raise resample.spacing_mm");
}

}  // namespace vicon::pipeline

#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>

#include "vicon/core/skeleton.h"
#include "vicon/core/volume.h"
#include "vicon/phantom/phantom.h"

namespace vicon::test {

/// What the chain of steps made of a scan.
struct ChainResult {
    HuVolume volume;
    InsideVolume inside;
    Skeleton curve;
    std::map<std::string, std::string> bytes;  ///< everything made, by name, to compare bit for bit
};

/// Resample, segment, skeleton, subdivide, cells and both potentials, with their defaults.
ChainResult runChain(HuVolume acquired, Vector3 gravity);
/// Resample only: "volume" of the same map.
ChainResult runResample(HuVolume acquired);

/// How a series lies on disk: pixel axes as (axis of the patient, direction), and the order of its files' names.
struct Storage {
    const char* name;
    std::array<int, 3> axis{0, 1, 2};  ///< 0 left, 1 posterior, 2 head: of row, column, slice
    std::array<int, 3> sign{1, 1, 1};
    bool shuffled = false;  ///< file names in no order
    bool whole = false;     ///< run all steps on it, not only resample, whose result is all that the others see
};

/// Writes the measured densities as a DICOM series stored in that way, imports it into a store, and hands back what is
/// read from there. `measured` must have its axes along the patient's.
HuVolume throughDicom(const HuVolume& measured, const Storage& storage, const std::filesystem::path& folder);

/// A phantom of a whole colon that is small enough for ordinary tests: 160 x 160 x 134 voxels of 2.375 x 2.375 x 3.25
/// mm (numbers that DICOM's decimal strings hold exactly), without the folds, which such voxels do not resolve.
phantom::PhantomOptions smallColon(std::uint64_t seed);

}  // namespace vicon::test

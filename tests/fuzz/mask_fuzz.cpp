// Whatever another program's lumen holds: it is one label's voxels in a lattice of the patient, or refused in one line.
#include <algorithm>
#include <cmath>
#include <optional>

#include "memory_file.h"
#include "one_line.h"
#include "vicon/core/error.h"
#include "vicon/ingest/mask_file.h"

using namespace vicon;

namespace {

constexpr double kLargest_mvoxel = 1;  // larger ones only take longer

void requireSound(const ingest::MaskFile& read)
{
    const Grid& grid = read.mask.grid;
    const auto& voxels = read.mask.voxels;
    fuzz::require(read.label != 0 && read.sha256.size() == 64);
    fuzz::require(voxels.size() == grid.voxelCount() && double(voxels.size()) <= kLargest_mvoxel * 1e6);
    fuzz::require(*std::max_element(voxels.begin(), voxels.end()) == 1);
    for (std::size_t a = 0; a < 3; ++a) {
        fuzz::require(grid.size[a] > 0 && grid.spacing_mm[a] > 0 && std::isfinite(grid.spacing_mm[a]));
        fuzz::require(std::abs(length(grid.axis[a]) - 1) < 1e-6);
    }
    for (const Point3 place : {grid.origin_mm, read.lattice_middle_mm})
        fuzz::require(std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z));
    for (const std::string& note : read.notes)
        fuzz::requireLine(note);
}

/// Returns whether a label must be chosen, or is not there.
bool needsAnother(const std::filesystem::path& file, std::optional<int> label)
try {
    NoProgress quiet;
    const ingest::MaskFile read = ingest::readMask(file, label, kLargest_mvoxel, quiet);
    fuzz::require(!label || read.label == *label);
    requireSound(read);
    return false;
} catch (const Error& e) {
    fuzz::requireLine(e.what());
    fuzz::require(e.code() == ErrorCode::bad_input || e.code() == ErrorCode::wrong_use);
    return e.code() == ErrorCode::wrong_use;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    file.fill(data, size);
    if (needsAnother(file.path(), std::nullopt))
        needsAnother(file.path(), 1);
    return 0;
}

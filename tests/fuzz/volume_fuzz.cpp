// Whatever a .mha holds, its voxels are those that its header describes, or it is refused.
#include <new>

#include "memory_file.h"
#include "vicon/core/error.h"
#include "vicon/scan_files/stored_volume.h"
#include "vicon/scan_files/volume_file.h"

using namespace vicon;

namespace {

template <class T>
void read(const std::filesystem::path& file)
{
    try {
        const Volume<T> volume = scan_files::readVolume<T>(file);
        fuzz::require(volume.voxels.size() == volume.grid.voxelCount());
    } catch (const Error&) {
    }
    try {
        const scan_files::StoredVolume<T> stored(file);
        const auto& view = stored.view();
        fuzz::require(view.voxels.size() == view.grid.voxelCount());
        double sum = 0;  // touches every voxel
        for (const T voxel : view.voxels)
            sum += double(voxel);
        fuzz::require(sum == sum || std::is_same_v<T, float>);
        stored.readAhead(0, view.voxels.size());
    } catch (const Error&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    file.fill(data, size);
    try {
        const Grid grid = scan_files::readGrid(file.path());
        for (const int count : grid.size)
            fuzz::require(count > 0);
    } catch (const Error&) {
    }
    read<std::uint8_t>(file.path());
    read<std::int16_t>(file.path());
    read<float>(file.path());
    return 0;
}

#pragma once

#include <filesystem>
#include <memory>

#include "vicon/core/volume_view.h"

namespace vicon::scan_files {

class MappedFile;

/// A volume as its file holds it. Raw voxels are mapped: opening costs nothing, and only what is looked at is read from
/// the disk. Packed ones are unpacked into memory. The file may be replaced or deleted meanwhile. Copies share it.
template <class T>
class StoredVolume {
public:
    /// Instantiated for the voxel types of core/volume.h. Throws as readVolume() does.
    explicit StoredVolume(const std::filesystem::path& file);

    const VolumeView<T>& view() const { return view_; }
    /// Asks the disk for the voxels [begin, end) now, a hint: who looks at them soon should not wait for every page.
    void readAhead(std::size_t begin, std::size_t end) const;

private:
    std::shared_ptr<const void> owner_;
    const MappedFile* mapped_ = nullptr;  // the owner, unless it was unpacked
    VolumeView<T> view_;
};

}  // namespace vicon::scan_files

#pragma once

#include <memory>
#include <optional>

#include "vicon/viewer/model/slice_slab.h"
#include "vicon/viewer/scene/reading_pictures.h"

namespace vicon::viewer {

/// Slices as the reading room shows them, one after the other, on one thread. Where neighbouring slices follow each
/// other that lie badly in memory, those around them are copied so that they lie well.
class SlicePictures {
public:
    // Both throw Error{cancelled} where `wanted` is no longer.
    /// As slicePicture().
    Picture draw(const std::shared_ptr<const PreparedScan>& scan, const SliceRequest& request,
                 const Progress* wanted = nullptr);
    /// Copies what the next slices will ask for, if it is worth it. Takes longer than a slice: to be called when the
    /// slice is on its way to the screen.
    void readAhead(const Progress* wanted = nullptr);

private:
    std::weak_ptr<const PreparedScan> scan_;  // of what was drawn last
    std::optional<double> plane_, earlier_plane_;
    std::optional<SliceSlab> slab_;
};

}  // namespace vicon::viewer

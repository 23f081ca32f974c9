#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vicon/viewer/model/camera.h"
#include "vicon/viewer/scene/canvas.h"
#include "vicon/viewer/scene/cell_visibility.h"

namespace vicon::viewer {

/// Which part of the wall a picture shows, by drawing it again with each triangle in a colour of its own. To be made,
/// used and destroyed on the thread of the pictures.
class PictureCoverage {
public:
    /// Throws as IdScene and Offscreen do.
    explicit PictureCoverage(const PreparedScan& scan);
    ~PictureCoverage();

    /// The picture that shall be told about.
    /// @param shown what was drawn in it
    void look(const VisibleParts& shown, const Pose& pose, const Lens& lens);
    /// The triangles in it: ascending, each once.
    std::vector<std::uint32_t> triangles() const;
    /// Green: the wall that was seen earlier. Orange: a region that was missed.
    enum class Tint { seen, missed };
    /// Tints wall in `picture`, which must show the same from the same place.
    /// @param which of each triangle: 1 or 0
    void tint(Picture& picture, const std::vector<std::uint8_t>& which, Tint as = Tint::seen) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace vicon::viewer

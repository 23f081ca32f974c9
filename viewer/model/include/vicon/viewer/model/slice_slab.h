#pragma once

#include <optional>

#include "vicon/core/progress.h"
#include "vicon/core/volume_view.h"
#include "vicon/viewer/model/camera.h"

namespace vicon::viewer {

/// A copy of some neighbouring planes of a volume across its first axis, each plane in one piece. In the volume itself
/// such a plane meets a new line of memory with each voxel, and 32 of its neighbours lie in the same lines.
class SliceSlab {
public:
    /// Passes once through the volume's lines; copies kPlanes planes around `plane`, fewer where the volume ends.
    /// Throws Error{cancelled} where `wanted` is no longer.
    SliceSlab(const HuView& volume, double plane, const Progress* wanted = nullptr);

    /// Which plane across the volume's first axis a picture shows, counted in voxels; nothing where it is no such
    /// plane.
    static std::optional<double> planeOf(const Grid& grid, const PlaneView& view);
    /// Whether the copy is all that is needed to show this plane.
    bool holds(double plane) const;
    /// The copy: a volume of its own, where planes are slowest.
    const HuVolume& volume() const { return volume_; }

    static constexpr int kPlanes = 33;  ///< those of one line of memory and a neighbour

private:
    int first_ = 0;
    bool at_begin_ = false, at_end_ = false;  // of the volume
    HuVolume volume_;
};

}  // namespace vicon::viewer

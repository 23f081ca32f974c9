#pragma once

#include <memory>
#include <optional>

#include "segment/body.h"
#include "vicon/core/volume.h"

namespace vicon::steps {

/// A connected set of voxels.
struct GrownRegion {
    InsideVolume mask;  ///< kGas; cropped to the set with a margin, as far as the scan goes
    std::size_t voxels = 0;
};

/// Grows regions inside the body by ITK's connected threshold. Holds the densities of the body's box once more.
class RegionGrower {
public:
    enum class Padding { counts, stops };

    /// @param padding whether voxels without a measurement count with the density that stands for them, or stop growth
    RegionGrower(const HuVolume& volume, const Body& body, Padding padding);
    ~RegionGrower();

    /// The voxel nearest to a point, at most `within_mm` away, that lies in the body between two densities.
    std::optional<Index3> seedAt(Point3 point, double within_mm, double low_hu, double high_hu) const;

    /// The voxels from `low_hu` to `high_hu` that are 6-connected to a seed; empty where the seed is none of them.
    /// @param margin of outside voxels around the region's box
    GrownRegion grow(Index3 seed, double low_hu, double high_hu, int margin);

private:
    struct Filter;
    Grid grid_;
    Index3 begin_;  ///< of the body's box in the scan
    HuVolume box_;
    std::unique_ptr<Filter> filter_;
};

}  // namespace vicon::steps

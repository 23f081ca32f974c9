#pragma once

#include <cstdint>

#include "scene.h"
#include "vicon/phantom/phantom.h"

namespace vicon::phantom {

/// What fills the lumen: gas, pools under their levels, lumps of stool, films on polyps.
class LumenContent {
public:
    LumenContent(const Scene& scene, const PhantomTruth& truth) : up_(-scene.down), truth_(truth) {}

    /// Mean density of a voxel of this size, to first order.
    /// @param pool number of the pool whose stations the voxel lies at, or LumenField::kNoPool
    double density_hu(Point3 p, std::uint8_t pool, double voxel_mm) const;
    /// kGas or kFluid, by the voxel's centre.
    std::uint8_t label(Point3 p, std::uint8_t pool) const;

private:
    Vector3 up_;
    const PhantomTruth& truth_;
};

}  // namespace vicon::phantom

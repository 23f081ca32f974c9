#pragma once

#include "tissue/mixture.h"

namespace vicon::steps {

/// Tells where gas meets tagging, and where a wall lies between them: there the densities stay longer near those of
/// tissue.
class DirectStep {
public:
    /// References must outlive it.
    /// @param blur_mm standard deviation of the point spread
    DirectStep(const Mixture& mixture, double blur_mm);

    static constexpr int kFarthest_voxels = 4;  ///< from gas to tagging

    /// Whether no wall lies between a voxel of gas and one of tagging, which lies so many steps off in a direction.
    bool isDirect(Index3 gas, Index3 direction, int steps) const;

private:
    const Mixture& mixture_;
    double thickest_mm_;
};

}  // namespace vicon::steps

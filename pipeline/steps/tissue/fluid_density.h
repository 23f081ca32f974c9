#pragma once

#include <array>
#include <vector>

#include "tissue/mixture.h"

namespace vicon::steps {

/// The density of the tagged fluid in and around each pool, place by place: tagging settles, and beams harden.
class FluidDensity {
public:
    /// References must outlive it.
    /// @param tag_contrast_hu TissueOptions::tag_contrast_hu
    FluidDensity(const Mixture& mixture, double noise_hu, double tag_contrast_hu);

    /// HU at a voxel; 0 where no fluid is near, or it is too faint to be told from tissue.
    double at(Index3 v) const;
    /// The same, in a layer of sediment that of what lies on both sides of the voxel; in a thin fold with sediment on
    /// one side up to the mean of both.
    double besides(Index3 v) const;

private:
    std::size_t index(int i, int j, int k) const
    {
        return std::size_t(i) + std::size_t(size_[0]) * (std::size_t(j) + std::size_t(size_[1]) * std::size_t(k));
    }
    void spreadBrightest();
    void smooth();
    void smoothBlock(Index3 block, const std::vector<float>& sum, const std::vector<float>& weight);
    void spread();

    const Mixture& mixture_;
    double noise_hu_;
    std::array<int, 3> size_{};  ///< blocks along each axis
    std::vector<float> sum_, weight_, brightest_;
    double least_hu_ = 0;
};

}  // namespace vicon::steps

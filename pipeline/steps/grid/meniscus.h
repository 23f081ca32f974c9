#pragma once

#include <cstdint>
#include <vector>

#include "vicon/core/volume.h"

namespace vicon::steps {

/// The faces at which gas and fluid touch. Around them the densities pass through those of tissue, and where a wall is
/// near too they say nothing about its place.
class Meniscus {
public:
    static constexpr int kReach_voxels = 2;  ///< two sigma of the widest point spread (0.8 mm) at the usual voxels

    explicit Meniscus(const InsideVolume& labels);

    /// Whether a voxel of gas that touches fluid lies within kReach_voxels along every axis.
    bool near(Index3 v) const;
    /// Voxels beside the wall, inside or outside, for which near() holds, in order of their offsets.
    std::vector<std::size_t> wallNear(const InsideVolume& labels) const;

private:
    void markRow(int j, int k, std::vector<std::uint8_t>& marked) const;

    Grid grid_;
    std::vector<std::uint32_t> row_begin_;
    std::vector<std::int32_t> columns_;  ///< i of the gas voxels that touch fluid, row by row
    std::vector<std::uint8_t> row_near_;
};

/// Weights 1 4 6 4 1 along each axis: of an offset from -2 to 2.
inline int binomial(int offset)
{
    return offset == 0 ? 6 : offset == 1 || offset == -1 ? 4 : 1;
}
/// Of the weights binomial() in three dimensions.
inline constexpr int kBinomialSum = 16 * 16 * 16;

/// Smooths the wall beside the lines where gas, fluid and wall meet: near them each voxel goes to the side, lumen or
/// outside, that has the larger share of the binomial neighbourhood around it.
void smoothAtMeniscus(InsideVolume& labels);

}  // namespace vicon::steps

#pragma once

#include <cstdint>
#include <vector>

#include "grid/components.h"
#include "grid/meniscus.h"
#include "vicon/core/volume.h"
#include "vicon/steps/wall_densities.h"

namespace vicon::steps {

/// Rows of voxels that hold an inside voxel or lie beside one that does; rows beyond the grid are known one deep.
class RowsNearLumen {
public:
    explicit RowsNearLumen(const InsideVolume& inside);
    bool near(int j, int k) const { return near_[index(j, k)] != 0; }

private:
    std::size_t index(int j, int k) const { return std::size_t(j + 1) + std::size_t(rows_) * std::size_t(k + 1); }
    int rows_;
    std::vector<std::uint8_t> near_;
};

/// Where the wall lies between an inside and an outside voxel, from the densities: a signed value of each voxel beside
/// the wall, below 0 inside, above 0 outside, about -1 and +1 away from the wall, linear in the density. Beside gas it
/// is 0 at the wall's density, under fluid half-way between tissue and the pool's own density, so one level serves
/// both. Where gas, fluid and wall meet the densities cannot tell, and the wall follows the mask, smoothed together
/// with what the densities tell around. The mask decides the sign.
class WallField {
public:
    /// References must outlive the field. Throws Error{bad_input} when the grids do not fit together.
    WallField(const HuVolume& hu, const InsideVolume& inside, const WallDensities& densities);

    /// The value of an inside voxel, in [-1, -kLeast].
    float ofInside(Index3 v) const;
    /// The value of an outside voxel (also beyond the grid), in [kLeast, 1]; 1 where no neighbour is inside.
    float ofOutside(Index3 v) const;

    /// Whether the densities around a voxel belong to the wall, not to a level between gas and fluid beside it.
    bool densitiesTell(Index3 v) const { return !meniscus_.near(v); }

    /// The density of the pool that a voxel belonged to, as fluid, when the field was made, in HU.
    double poolDensity(Index3 fluid) const { return pool_hu_[pools_.at(fluid)]; }
    double poolDensity(const Run& of_fluid) const { return pool_hu_[of_fluid.component]; }
    /// The standard deviation of a pool's densities without what partial volume makes darker, in HU.
    double poolNoise(const Run& of_fluid) const { return pool_noise_hu_[of_fluid.component]; }
    /// The runs of fluid when the field was made.
    const std::vector<Run>& fluidRuns() const { return pools_.runs(); }

    /// The density, or `otherwise` where none was measured.
    double hu(Index3 v, double otherwise) const;
    /// The gradient of the densities by central differences, in HU per voxel along the grid's axes.
    Vector3 gradient(Index3 v) const;

    /// The bottom of a thin fold lies this near to its slopes. Chosen on ctc-prone and on the default phantom's seeds
    /// 301, 303 and 310 (low dose).
    static constexpr int kFoldBottom_voxels = 2;

    /// The wall keeps this part of an edge away from both its voxels.
    static constexpr float kLeast = 0.02F;

private:
    double valueBeside(Index3 labelled, std::uint8_t label, double density) const;
    bool besideThinFold(Index3 fluid) const;
    double asThickFold(Index3 v, Index3 fluid, double density) const;
    float fromDensities(Index3 v) const;
    float smoothed(Index3 v) const;
    void measurePools();

    const HuVolume& hu_;
    const InsideVolume& inside_;
    WallDensities densities_;
    Index3 offset_;
    Components pools_;
    Meniscus meniscus_;
    std::vector<double> pool_hu_, pool_noise_hu_;
};

}  // namespace vicon::steps

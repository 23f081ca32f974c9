#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "grid/along_axis.h"
#include "tissue/fluid_density.h"
#include "vicon/steps/tissue.h"

namespace vicon::steps {

/// Depth along gravity as a linear function of a voxel's place, in voxels of the axis nearest to gravity.
struct DownAxis {
    DownAxis(const Grid& grid, Vector3 gravity);
    double depth(Index3 v) const { return per_voxel.x * v.i + per_voxel.y * v.j + per_voxel.z * v.k; }
    int along(Index3 v) const { return coordinate(v, axis); }
    Index3 moved(Index3 v, int steps) const { return beside(v, axis, steps * sign); }

    int axis = 1;
    int sign = 1;
    double upright = 1;  ///< depth of one voxel down the axis
    Vector3 per_voxel;
};

/// The plane of a level where it passes through one column of voxels.
struct LevelColumn {
    Index3 at;           ///< the voxel nearest to the plane
    float depth = 0;     ///< of the plane, see DownAxis
    float sigma = 0;     ///< of the blur across it, in the same unit
    float fluid_hu = 0;  ///< right below it
};

struct FluidLevels {
    std::vector<LevelColumn> columns;  ///< of gas over fluid, and of the plane's continuation around them
    double sigma_voxels = 0;           ///< of the blur across all levels; 0 without any
    std::size_t fitted = 0;            ///< columns of pure gas over pure fluid that they were fitted to
};

/// Finds where gas stands on fluid, and fits the levels.
/// @param usual_blur_mm TissueOptions::usual_blur_mm
FluidLevels findLevels(const Mixture& mixture, const FluidDensity& fluid, const DownAxis& down, double usual_blur_mm);

/// The depth at which the densities pass that of tissue, on the way down, nearest to a voxel. There the lumen has
/// tissue's density too, so it matters little how much of the column is wall.
/// @param reach how many voxels above and below are looked at
std::optional<double> crossingNear(const Mixture& mixture, const DownAxis& down, Index3 v, int reach);
/// Where the middle of the step lies when it passes tissue's density at `crossing`.
double planeOf(double crossing, const LevelColumn& column, const Mixture& mixture);

/// What a voxel's density says of the tissue in it, if all else has another density.
struct TissueShare {
    double fraction = 0;
    double weight = 0;  ///< 1 where that density is far from tissue's, 0 where it is tissue's
};
TissueShare tissueBeside(const Mixture& mixture, double hu, double content_hu, double fluid_hu);

/// Sets the fraction of tissue in the blurred layers of the levels: gas and fluid share what is not tissue as the
/// blurred plane does.
/// @return how many voxels were set; where two layers overlap, each once
std::size_t applyLevels(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels, double noise_hu,
                        TissueVolume& tissue);

}  // namespace vicon::steps

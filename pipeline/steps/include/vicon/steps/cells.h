#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vicon/core/cell_surface.h"
#include "vicon/core/option_names.h"
#include "vicon/core/options.h"
#include "vicon/core/progress.h"
#include "vicon/core/subdivision.h"
#include "vicon/core/volume.h"
#include "vicon/steps/tissue.h"
#include "vicon/steps/wall_densities.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {

/// The surface of the lumen, contoured once for all segments: closed, every edge in exactly two triangles, triangles in
/// order of their segment and within it in such an order that any run of them is a compact patch, front sides and unit
/// normals towards the lumen.
///
/// The mask decides which voxel is inside, the densities where between two voxels the wall lies: beside gas at
/// `wall_hu`, under fluid half-way between tissue and the local fluid. Between gas and fluid there is no surface.
/// Normals are the gradient of the densities. `hu` must lie on the lattice of `inside` and may be larger; `segments`
/// has the grid of `inside`, and each triangle takes the segment of the inside voxel that it is nearest to.
/// The result does not depend on the number of threads. Throws Error{bad_input} when the grids do not fit together.
CellSurface extractCells(const HuVolume& hu, const InsideVolume& inside, const SegmentVolume& segments,
                         const WallDensities& densities, Progress& progress);

/// What the wall's place is taken from.
enum class WallSource { densities, tissue };
inline constexpr EnumNames<WallSource, 2> kWallSourceNames{{
    {WallSource::densities, "densities"},
    {WallSource::tissue, "tissue"},
}};
constexpr const auto& optionNames(WallSource /*value*/)
{
    return kWallSourceNames;
}

struct WallOptions {
    WallSource wall = WallSource::tissue;

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("subdivide.wall", wall, "",
          "densities: the wall lies between the labels, where they say; tissue: where half of a voxel is tissue.",
          choicesOf(wall));
    }
};

/// The same in two parts: the contour needs no segments and can be made while the lumen is divided.
class LumenSurface {
public:
    /// `hu` and `inside` must outlive the surface. Throws Error{bad_input} when their grids do not fit together.
    LumenSurface(const HuVolume& hu, const InsideVolume& inside, const WallDensities& densities, Progress& progress);
    /// The wall where half of a voxel is tissue, in one field through gas, levels and fluid. Normals are the gradient
    /// of the fraction. Both must outlive the surface. Throws Error{bad_input} when their grids differ.
    /// @param lumen TissueResult::lumen
    LumenSurface(const TissueVolume& tissue, const InsideVolume& lumen, Progress& progress);
    ~LumenSurface();
    LumenSurface(LumenSurface&&) noexcept;
    LumenSurface& operator=(LumenSurface&&) noexcept;

    /// Throws Error{bad_input} when the segments do not lie on the grid of the labels.
    CellSurface cellsOf(const SegmentVolume& segments, Progress& progress) const;

    /// The voxels beside the wall with their distances from the surface, for wallDistance(); in order of
    /// their offsets.
    const std::vector<NearWall>& nearWall() const;

private:
    struct Parts;
    std::unique_ptr<const Parts> parts_;
};

/// Fills in the triangle counts of the description and the statistics of the thesis' Table 2: "triangles",
/// "triangles_average", "triangles_largest", "triangles_smallest", "triangles_standard_deviation".
void countTriangles(const CellSurface& surface, Subdivision& description);

}  // namespace vicon::steps

#include "vicon/steps/densities_around.h"

#include "grid/lattice.h"
#include "grid/voxel_box.h"

namespace vicon::steps {
namespace {

// A wall field reads 6 voxels beyond the labels at most: 1 of padding, 2 around a meniscus, 1 beside, 2 across a fold.
constexpr int kBeyond_voxels = 8;

}  // namespace

HuVolume densitiesAround(const HuVolume& volume, const Grid& part)
{
    const Index3 at = latticeOffset(part, volume.grid);
    const auto [nx, ny, nz] = part.size;
    return cropped(volume, VoxelBox{at, {at.i + nx, at.j + ny, at.k + nz}}.grown(kBeyond_voxels, volume.grid));
}

}  // namespace vicon::steps

#include "grid/mask.h"

#include <algorithm>

#include "grid/neighbours.h"

namespace vicon::steps {

bool besideOther(const InsideVolume& inside, Index3 v)
{
    const Grid& grid = inside.grid;
    const auto [nx, ny, nz] = grid.size;
    if (v.i > 0 && v.j > 0 && v.k > 0 && v.i + 1 < nx && v.j + 1 < ny && v.k + 1 < nz) {
        const std::uint8_t* at = &inside.voxels[grid.offset(v)];
        const std::ptrdiff_t row = nx, slice = row * ny;
        const int around =
            (at[-1] != 0) + (at[1] != 0) + (at[-row] != 0) + (at[row] != 0) + (at[-slice] != 0) + (at[slice] != 0);
        return *at ? around < 6 : around > 0;
    }
    const bool here = inside.valueOr(v, kOutside) != kOutside;
    return std::any_of(kFaces.begin(), kFaces.end(),
                       [&](Index3 face) { return (inside.valueOr(shifted(v, face), kOutside) != kOutside) != here; });
}

}  // namespace vicon::steps

#pragma once

#include <cmath>

#include "vicon/core/error.h"
#include "vicon/core/geometry.h"

namespace vicon::steps {

/// The index in `outer` of voxel (0,0,0) of `inner`, for two grids on one lattice. Throws Error{bad_input} when their
/// spacings, axes or phases differ by more than a thousandth of a voxel.
inline Index3 latticeOffset(const Grid& inner, const Grid& outer)
{
    constexpr double kSame = 1e-3;  // of a voxel; far above rounding, far below what a reader sees
    bool same = true;
    for (std::size_t d = 0; d < 3; ++d)
        same = same && std::abs(inner.spacing_mm[d] - outer.spacing_mm[d]) < kSame * outer.spacing_mm[d] / 100 &&
               length(inner.axis[d] - outer.axis[d]) < kSame / 100;
    const ContinuousIndex3 c = outer.continuousIndexAt(inner.origin_mm);
    const Index3 at = outer.indexAt(inner.origin_mm);
    same = same && std::abs(c.i - at.i) < kSame && std::abs(c.j - at.j) < kSame && std::abs(c.k - at.k) < kSame;
    if (!same)
        throw Error(ErrorCode::bad_input, "the densities and the labels do not lie on one lattice", {},
                    "run 'vicon work' to make the labels anew");
    return at;
}

}  // namespace vicon::steps

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::steps {

/// Calls use(index) for those of the elements, ordered by their member `voxel`, that lie at most `reach` steps along
/// each axis from a voxel.
template <class Element, class Use>
void forThoseNear(const std::vector<Element>& elements, const Grid& grid, std::size_t voxel, int reach, Use use)
{
    const Index3 v = grid.indexOf(voxel);
    for (int k = v.k - reach; k <= v.k + reach; ++k)
        for (int j = v.j - reach; j <= v.j + reach; ++j) {
            if (!grid.contains({v.i, j, k}))
                continue;
            const std::size_t from = grid.offset({std::max(0, v.i - reach), j, k});
            const std::size_t last = grid.offset({std::min(grid.size[0] - 1, v.i + reach), j, k});
            auto at = std::lower_bound(elements.begin(), elements.end(), from,
                                       [](const Element& element, std::size_t n) { return element.voxel < n; });
            for (; at != elements.end() && at->voxel <= last; ++at)
                use(std::size_t(at - elements.begin()));
        }
}

}  // namespace vicon::steps

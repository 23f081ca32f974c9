#include "resample/oriented_scan.h"

#include <algorithm>
#include <cmath>

namespace vicon::steps {
namespace {

/// Origins are rounded to this, so that mirrored storage, whose origin is computed from the other end, gives the same.
constexpr double kOriginStep_mm = 1e-6;
constexpr std::array<unsigned, 3> kAsStored{0, 1, 2};

std::array<unsigned, 3> nearestPermutation(const std::array<Vector3, 3>& axis)
{
    std::array<unsigned, 3> order = kAsStored, best = order;
    double most = -1;
    do {
        const double along = std::abs(axis[order[0]].x) + std::abs(axis[order[1]].y) + std::abs(axis[order[2]].z);
        if (along > most + 1e-9) {
            most = along;
            best = order;
        }
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

double onOriginStep(double mm)
{
    return std::round(mm / kOriginStep_mm) * kOriginStep_mm + 0.0;
}

}  // namespace

bool OrientedScan::asStored() const
{
    return order == kAsStored && flipped == std::array<bool, 3>{};
}

OrientedScan orient(HuVolume& acquired)
{
    const Grid& from = acquired.grid;
    OrientedScan scan{.acquired = acquired, .order = nearestPermutation(from.axis), .grid = from};
    for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t a = scan.order[d];
        const Vector3 axis = from.axis[a];
        const double component = d == 0 ? axis.x : d == 1 ? axis.y : axis.z;
        const double sign = component < 0 ? -1 : 1;
        scan.flipped[d] = sign < 0;
        scan.grid.size[d] = from.size[a];
        scan.grid.spacing_mm[d] = from.spacing_mm[a];
        // Adding 0 makes 0 of -0, so that mirrored storage gives the same bits.
        scan.grid.axis[d] = {sign * axis.x + 0.0, sign * axis.y + 0.0, sign * axis.z + 0.0};
        if (scan.flipped[d])
            scan.grid.origin_mm += axis * (from.spacing_mm[a] * (from.size[a] - 1));
    }
    const Point3 origin = scan.grid.origin_mm;
    scan.grid.origin_mm = {onOriginStep(origin.x), onOriginStep(origin.y), onOriginStep(origin.z)};
    return scan;
}

}  // namespace vicon::steps

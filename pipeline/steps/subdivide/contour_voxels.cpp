#include <cmath>
#include <utility>

#include "subdivide/contour.h"

namespace vicon::steps {
namespace {

/// The edge between an inside and an outside voxel that a point of the contour lies on.
struct Edge {
    Index3 inside, outside;
    double to_outside = 0;  ///< 0 at the inside voxel, 1 at the outside one
};

Edge edgeAt(const float* p, const InsideVolume& inside)
{
    Index3 low{int(std::floor(p[0])), int(std::floor(p[1])), int(std::floor(p[2]))}, high = low;
    const double part[3] = {double(p[0]) - low.i, double(p[1]) - low.j, double(p[2]) - low.k};
    // Exactly one coordinate lies between voxels; the others are whole numbers, which floats hold exactly.
    const int along = part[0] > 0 ? 0 : part[1] > 0 ? 1 : 2;
    (along == 0 ? high.i : along == 1 ? high.j : high.k) += 1;
    if (inside.valueOr(low, kOutside) != kOutside)
        return {low, high, part[along]};
    return {high, low, 1 - part[along]};
}

/// The corners of the cell of voxels that a point lies in.
NearVoxels cornersAround(const float* p, const InsideVolume& inside)
{
    const Index3 low{int(std::floor(p[0])), int(std::floor(p[1])), int(std::floor(p[2]))};
    NearVoxels around;
    for (int n = 0; n < 8; ++n) {
        const std::array<int, 3> high{n & 1, n >> 1 & 1, n >> 2};
        const auto share = [&](int d, int at) {
            const double part = double(p[d]) - at;
            return high[std::size_t(d)] ? part : 1 - part;
        };
        around.voxels[around.count] = {low.i + high[0], low.j + high[1], low.k + high[2]};
        around.weights[around.count++] = share(0, low.i) * share(1, low.j) * share(2, low.k);
    }
    std::size_t nearest = 0;
    double most = -1;
    for (std::size_t n = 0; n < around.count; ++n)
        if (inside.valueOr(around.voxels[n], kOutside) != kOutside && around.weights[n] > most) {
            most = around.weights[n];
            nearest = n;
        }
    std::swap(around.voxels[0], around.voxels[nearest]);
    std::swap(around.weights[0], around.weights[nearest]);
    return around;
}

}  // namespace

NearVoxels voxelsNear(const Contour& contour, std::size_t point, const InsideVolume& inside)
{
    const float* p = &contour.points[3 * point];
    if (point >= contour.on_edges)
        return cornersAround(p, inside);
    const Edge edge = edgeAt(p, inside);
    return {{edge.inside, edge.outside}, {1 - edge.to_outside, edge.to_outside}, 2};
}

}  // namespace vicon::steps

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench_support.h"

namespace vicon::bench {
namespace {

constexpr int kWidth = 300, kDepth = 300, kHeight = 500;
constexpr double kVoxel_mm = 0.7, kRadius_mm = 16;

void addBall(const InsideVolume& inside, const SkeletonPoint& p, std::vector<float>& away2)
{
    const Index3 c = inside.grid.indexAt(p.position_mm);
    const int reach = int((kRadius_mm + 2) / kVoxel_mm) + 1;
    for (int k = c.k - reach; k <= c.k + reach; ++k)
        for (int j = c.j - reach; j <= c.j + reach; ++j)
            for (int i = c.i - reach; i <= c.i + reach; ++i)
                if (const Index3 v{i, j, k}; inside.grid.contains(v)) {
                    const Vector3 d = inside.grid.pointAt(v) - p.position_mm;
                    auto& least = away2[inside.grid.offset(v)];
                    least = std::min(least, float(dot(d, d)));
                }
}

}  // namespace

Tube::Tube()
    : inside(Grid{.size = {kWidth, kDepth, kHeight}, .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}}),
      hu(inside.grid, 40)
{
    const std::vector<Point3> corners{{30, 40, 40},  {30, 40, 310},  {90, 160, 310},  {90, 160, 40},
                                      {150, 40, 40}, {150, 40, 310}, {180, 160, 310}, {180, 160, 40}};
    SkeletonPiece piece;
    double station = 0;
    for (std::size_t n = 0; n + 1 < corners.size(); ++n) {
        const double length_mm = distance(corners[n], corners[n + 1]);
        for (double s = 0; s < length_mm; s += 1)
            piece.points.push_back({interpolate(corners[n], corners[n + 1], s / length_mm), station + s, kRadius_mm});
        station += length_mm;
    }
    skeleton.pieces.push_back(piece);
    std::vector<float> away2(inside.voxels.size(), std::numeric_limits<float>::max());
    for (const SkeletonPoint& p : piece.points)
        addBall(inside, p, away2);
    for (std::size_t n = 0; n < away2.size(); ++n) {
        const double beyond = std::min(std::sqrt(double(away2[n])), 1e3) - kRadius_mm;
        hu.voxels[n] = std::int16_t(std::lround(-1000 + 1040 * std::clamp(0.5 + beyond / 2, 0.0, 1.0)));
        inside.voxels[n] = hu.voxels[n] < -480 ? kGas : kOutside;
    }
    path.emplace_back();
    for (double s = 0; s < station - 1; s += 0.3) {
        const Point3 p = inside.grid.pointAt(inside.grid.indexAt(skeleton.at(s).position_mm));
        if (path[0].empty() || path[0].back() != p)
            path[0].push_back(p);
    }
}

const Tube& tube()
{
    static const Tube the_tube;
    return the_tube;
}

}  // namespace vicon::bench

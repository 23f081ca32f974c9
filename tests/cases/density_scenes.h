#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "vicon/core/volume_view.h"

namespace vicon::test {

/// A scene blurred as by a scanner's kernel; its lumen is where it is nearer to gas than to tissue.
struct Blurred {
    HuVolume volume;
    InsideVolume inside;

    /// @param densityAt of the unblurred scene
    template <class DensityAt>
    Blurred(DensityAt densityAt, double spacing_mm, double blur_mm, double tissue_hu = 40)
    {
        constexpr double kHalf_mm = 12;
        const double fine_mm = spacing_mm / 2;
        Grid grid;
        const int n = 2 * int(kHalf_mm / spacing_mm) + 1;
        grid.size = {n, n, n};
        grid.spacing_mm = {spacing_mm, spacing_mm, spacing_mm};
        const double first = -(n - 1) / 2.0 * spacing_mm;
        grid.origin_mm = {first, first, first};
        Grid fine = grid;
        fine.size = {2 * n, 2 * n, 2 * n};
        fine.spacing_mm = {fine_mm, fine_mm, fine_mm};
        Volume<float> scene(fine);
        for (std::size_t v = 0; v < scene.voxels.size(); ++v)
            scene.voxels[v] = float(densityAt(fine.pointAt(fine.indexOf(v))));
        for (int axis = 0; axis < 3; ++axis)
            blur(scene, axis, blur_mm / fine_mm);
        volume = HuVolume(grid);
        inside = InsideVolume(grid, kOutside);
        for (std::size_t v = 0; v < volume.voxels.size(); ++v) {
            const Index3 at = grid.indexOf(v);
            volume.voxels[v] = std::int16_t(std::lround(scene.at({2 * at.i, 2 * at.j, 2 * at.k})));
            inside.voxels[v] = volume.voxels[v] < (tissue_hu - 1000) / 2 ? kGas : kOutside;
        }
    }

private:
    static void blur(Volume<float>& scene, int axis, double sigma)
    {
        const int reach = int(3.5 * sigma) + 1, n = scene.grid.size[0];
        std::vector<double> weights;
        for (int d = -reach; d <= reach; ++d)
            weights.push_back(std::exp(-d * d / (2 * sigma * sigma)));
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        std::vector<float> row;
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                const auto at = [&](int c) -> float& {
                    return scene.at(axis == 0 ? Index3{c, a, b} : axis == 1 ? Index3{a, c, b} : Index3{a, b, c});
                };
                row.clear();
                for (int c = 0; c < n; ++c) {
                    double value = 0;
                    for (int d = -reach; d <= reach; ++d)
                        value += weights[std::size_t(d + reach)] * at(std::clamp(c + d, 0, n - 1));
                    row.push_back(float(value / sum));
                }
                for (int c = 0; c < n; ++c)
                    at(c) = row[std::size_t(c)];
            }
    }
};

/// A sessile polyp, half a ball or more on a wall of 1.6 mm before fat, as the phantom makes them; the lumen is where
/// x is above 0.
struct Polyp : Blurred {
    Polyp(double diameter_mm, double tissue_hu, double spacing_mm, double blur_mm)
        : Blurred(
              [=](Point3 p) {
                  constexpr double kWall_mm = 1.6, kFat_hu = -98;
                  const bool in_ball = distance(p, {}) < diameter_mm / 2;
                  return in_ball ? tissue_hu : p.x > 0 ? -1000 : p.x > -kWall_mm ? 42 : kFat_hu;
              },
              spacing_mm, blur_mm, tissue_hu)
    {
    }
};

/// A bare wall before fat, and muscle behind the fat.
struct FlatWall : Blurred {
    FlatWall(double wall_mm, double spacing_mm, double blur_mm)
        : Blurred(
              [=](Point3 p) {
                  constexpr double kFat_mm = 4;
                  return p.x > 0 ? -1000.0 : p.x > -wall_mm ? 40.0 : p.x > -wall_mm - kFat_mm ? -90.0 : 60.0;
              },
              spacing_mm, blur_mm)
    {
    }
};

}  // namespace vicon::test

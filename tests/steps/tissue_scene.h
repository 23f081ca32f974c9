#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "vicon/steps/tissue.h"

namespace vicon::steps {

inline constexpr double kGasHu = -1000, kTissueHu = 40, kFluidHu = 700, kSigma_mm = 0.7, kVoxel_mm = 0.7;
inline constexpr Vector3 kDown{0, 1, 0};  // supine; levels lie at y = 0.1

/// How far down the fluid begins: everywhere alike, or higher where it has risen along a wall.
struct Level {
    Level(double depth_mm) : at([depth_mm](Point3) { return depth_mm; }) {}
    Level(std::function<double(Point3)> depth_mm) : at(std::move(depth_mm)) {}
    std::function<double(Point3)> at;
};

/// A blurred scan of tissue with gas above the level and fluid below it.
struct Scene {
    using IsTissue = std::function<bool(Point3)>;

    explicit Scene(const IsTissue& isTissue, const Level& level = 0.1, double noise_hu = 0, int size = 48,
                   Vector3 down = kDown)
        : grid{.size = {size, size, size}, .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}},
          hu(grid),
          inside(grid),
          truth(grid),
          down(down)
    {
        const double half = (size - 1) * kVoxel_mm / 2;
        grid.origin_mm = {-half, -half, -half};
        hu.grid = inside.grid = truth.grid = grid;
        const std::vector<float> tissue = blurred([&](Point3 p) { return isTissue(p) ? 1.0 : 0.0; });
        const std::vector<float> fluid =
            blurred([&](Point3 p) { return !isTissue(p) && dot(p - Point3{}, down) > level.at(p) ? 1.0 : 0.0; });
        std::mt19937 random(7);
        std::normal_distribution<double> noise(0, std::max(noise_hu, 1e-9));
        for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
            const double s = tissue[n], f = fluid[n];
            truth.voxels[n] = float(s);
            hu.voxels[n] = std::int16_t(
                std::lround(s * kTissueHu + f * kFluidHu + (1 - s - f) * kGasHu + (noise_hu > 0 ? noise(random) : 0)));
            const Point3 p = grid.pointAt(grid.indexOf(n));
            inside.voxels[n] = s >= 0.5 ? kOutside : dot(p - Point3{}, down) > level.at(p) ? kFluid : kGas;
        }
    }

    TissueResult find(double noise_hu = 20, const std::vector<Point3>& cuts_mm = {}) const
    {
        NoProgress quiet;
        return findTissue(hu, inside, down, {}, noise_hu, quiet, {}, cuts_mm);
    }

    /// As the step would find it without noise.
    TissueVolume blurredTruth() const
    {
        TissueVolume blurred(grid);
        std::transform(truth.voxels.begin(), truth.voxels.end(), blurred.voxels.begin(),
                       [](float s) { return std::uint8_t(std::lround(255 * s)); });
        return blurred;
    }

    /// Calls use(place, found fraction, true fraction) for the voxels at least `margin_mm` within the scan.
    template <class Use>
    void forEach(const TissueVolume& tissue, double margin_mm, Use use) const
    {
        const double half = -grid.origin_mm.x - margin_mm;
        for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            if (std::abs(p.x) < half && std::abs(p.y) < half && std::abs(p.z) < half)
                use(p, tissue.voxels[n] / 255.0, double(truth.voxels[n]));
        }
    }

    Grid grid;
    HuVolume hu;
    InsideVolume inside;
    Volume<float> truth;
    Vector3 down;

private:
    /// The Gaussian mean of a function, sampled at half of the voxel's edge.
    std::vector<float> blurred(const std::function<double(Point3)>& f) const
    {
        const int fine = 2 * grid.size[0], reach = int(std::ceil(4 * kSigma_mm / (kVoxel_mm / 2)));
        const auto at = [fine](int i, int j, int k) {
            return std::size_t(i) + std::size_t(fine) * (std::size_t(j) + std::size_t(fine) * std::size_t(k));
        };
        std::vector<float> values(at(0, 0, fine)), kernel;
        for (int k = 0; k < fine; ++k)
            for (int j = 0; j < fine; ++j)
                for (int i = 0; i < fine; ++i)
                    values[at(i, j, k)] = float(f(grid.pointAt(ContinuousIndex3{i / 2.0, j / 2.0, k / 2.0})));
        double sum = 0;
        for (int n = -reach; n <= reach; ++n) {
            kernel.push_back(float(std::exp(-0.5 * std::pow(n * kVoxel_mm / 2 / kSigma_mm, 2))));
            sum += kernel.back();
        }
        for (const std::size_t stride : {at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)}) {
            const std::vector<float> from = values;
            for (std::size_t n = 0; n < values.size(); ++n) {
                const int place = int(n / stride % std::size_t(fine));
                double mean = 0;
                for (int m = -reach; m <= reach; ++m) {
                    const int other = std::clamp(place + m, 0, fine - 1) - place;
                    mean += double(kernel[std::size_t(m + reach)]) *
                            double(from[std::size_t(std::ptrdiff_t(n) + other * std::ptrdiff_t(stride))]);
                }
                values[n] = float(mean / sum);
            }
        }
        std::vector<float> out(grid.voxelCount());
        for (std::size_t n = 0; n < out.size(); ++n) {
            const Index3 v = grid.indexOf(n);
            out[n] = values[at(2 * v.i, 2 * v.j, 2 * v.k)];
        }
        return out;
    }
};

/// How far from a place along a direction the fraction falls to one half, mm.
inline double toWall_mm(const TissueVolume& tissue, Point3 from, Vector3 direction)
{
    constexpr double kStep_mm = 0.05;
    const auto at = [&](double off_mm) {
        const ContinuousIndex3 p = tissue.grid.continuousIndexAt(from + direction * off_mm);
        double sum = 0;
        for (int n = 0; n < 8; ++n) {
            const Index3 v{int(std::floor(p.i)) + (n & 1), int(std::floor(p.j)) + (n >> 1 & 1),
                           int(std::floor(p.k)) + (n >> 2)};
            sum += (1 - std::abs(p.i - v.i)) * (1 - std::abs(p.j - v.j)) * (1 - std::abs(p.k - v.k)) *
                   tissue.valueOr(v, 255) / 255.0;
        }
        return sum;
    };
    double off_mm = 0;
    while (off_mm < 15 && at(off_mm) >= 0.5)
        off_mm += kStep_mm;
    return off_mm;
}

}  // namespace vicon::steps

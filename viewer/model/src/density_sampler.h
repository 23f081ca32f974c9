#pragma once

#include <algorithm>
#include <cmath>

#include "vicon/core/volume.h"

namespace vicon::viewer {

/// Trilinear densities for rays: positions and directions are turned into voxels once for each ray.
class DensitySampler {
public:
    explicit DensitySampler(const HuVolume& volume)
        : grid_(&volume.grid),
          voxels_(volume.voxels.data()),
          row_(volume.grid.size[0]),
          slice_(std::ptrdiff_t(volume.grid.size[0]) * volume.grid.size[1])
    {
    }

    /// A position in voxels.
    ContinuousIndex3 indexAt(Point3 p) const { return grid_->continuousIndexAt(p); }
    /// A displacement in voxels.
    ContinuousIndex3 indexStep(Vector3 v) const
    {
        return {dot(v, grid_->axis[0]) / grid_->spacing_mm[0], dot(v, grid_->axis[1]) / grid_->spacing_mm[1],
                dot(v, grid_->axis[2]) / grid_->spacing_mm[2]};
    }

    /// False outside the scan and beside padding.
    bool sample(double x, double y, double z, float& density_hu) const
    {
        const double fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
        if (!(fx >= 0 && fy >= 0 && fz >= 0 && fx < grid_->size[0] - 1 && fy < grid_->size[1] - 1 &&
              fz < grid_->size[2] - 1))
            return false;
        const std::int16_t* v = voxels_ + std::ptrdiff_t(fx) + row_ * std::ptrdiff_t(fy) + slice_ * std::ptrdiff_t(fz);
        const std::int16_t* w = v + slice_;
        const int darkest = std::min(std::min(std::min<int>(v[0], v[1]), std::min<int>(v[row_], v[row_ + 1])),
                                     std::min(std::min<int>(w[0], w[1]), std::min<int>(w[row_], w[row_ + 1])));
        if (darkest <= kPaddingHu && holdsPadding(v, w))
            return false;
        const auto tx = float(x - fx), ty = float(y - fy), tz = float(z - fz);
        const float near = mixed(v, tx, ty), far = mixed(w, tx, ty);
        density_hu = near + tz * (far - near);
        return true;
    }

    /// The gradient in patient coordinates, per voxel, from samples one voxel apart; zero where one is missing.
    Vector3 gradient(double x, double y, double z) const
    {
        float lower[3], upper[3];
        if (!sample(x - 1, y, z, lower[0]) || !sample(x + 1, y, z, upper[0]) || !sample(x, y - 1, z, lower[1]) ||
            !sample(x, y + 1, z, upper[1]) || !sample(x, y, z - 1, lower[2]) || !sample(x, y, z + 1, upper[2]))
            return {};
        Vector3 sum;
        for (std::size_t a = 0; a < 3; ++a)
            sum += grid_->axis[a] * (double(upper[a] - lower[a]) / grid_->spacing_mm[a]);
        return sum;
    }

private:
    float mixed(const std::int16_t* v, float tx, float ty) const
    {
        const float front = float(v[0]) + tx * float(v[1] - v[0]);
        const float back = float(v[row_]) + tx * float(v[row_ + 1] - v[row_]);
        return front + ty * (back - front);
    }
    bool holdsPadding(const std::int16_t* v, const std::int16_t* w) const
    {
        for (const std::int16_t* p : {v, v + row_, w, w + row_})
            if (p[0] == kPaddingHu || p[1] == kPaddingHu)
                return true;
        return false;
    }

    const Grid* grid_;
    const std::int16_t* voxels_;
    std::ptrdiff_t row_, slice_;
};

}  // namespace vicon::viewer

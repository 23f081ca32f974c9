#pragma once

#include <cmath>
#include <cstring>

#include "vicon/core/volume_view.h"

namespace vicon::viewer {

/// Trilinear densities for rays: positions and directions are turned into voxels once for each ray.
class DensitySampler {
public:
    explicit DensitySampler(const HuView& volume)
        : grid_(volume.grid),
          voxels_(volume.voxels.data()),
          row_(volume.grid.size[0]),
          slice_(std::ptrdiff_t(volume.grid.size[0]) * volume.grid.size[1])
    {
        for (std::size_t a = 0; a < 3; ++a) {
            last_[a] = float(volume.grid.size[a] - 1);
            per_voxel_[a] = volume.grid.axis[a] / volume.grid.spacing_mm[a];
        }
    }

    /// A place in voxels.
    struct Place {
        float x = 0, y = 0, z = 0;
    };
    Place indexAt(Point3 p) const
    {
        const ContinuousIndex3 c = grid_.continuousIndexAt(p);
        return {float(c.i), float(c.j), float(c.k)};
    }
    /// A displacement in voxels.
    Place indexStep(Vector3 v) const
    {
        return {float(dot(v, per_voxel_[0])), float(dot(v, per_voxel_[1])), float(dot(v, per_voxel_[2]))};
    }

    /// False outside the scan and beside padding.
    bool sample(Place p, float& density_hu) const
    {
        if (!(p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < last_[0] && p.y < last_[1] && p.z < last_[2]))
            return false;
        const Cell cell = cellAt(p);
        const std::int16_t *v = cell.first, *w = v + slice_;
        if (holdsPadding(pairs(v, v + row_)) || holdsPadding(pairs(w, w + row_)))
            return false;
        const float near = mixed(v, cell.x, cell.y), far = mixed(w, cell.x, cell.y);
        density_hu = near + cell.z * (far - near);
        return true;
    }

    /// The gradient in patient coordinates, from trilinear samples one voxel to either side; zero where one of them is
    /// missing. All six lie in shifted copies of one cell, so they are taken together.
    Vector3 gradient(Place p) const
    {
        if (!(p.x >= 1 && p.y >= 1 && p.z >= 1 && p.x < last_[0] - 1 && p.y < last_[1] - 1 && p.z < last_[2] - 1))
            return {};
        const Cell cell = cellAt(p);
        const std::int16_t* v = cell.first;
        if (paddingAround(v))
            return {};
        float x = 0, y = 0, z = 0;
        for (int corner = 0; corner < 4; ++corner) {
            const bool back = corner & 1, up = corner & 2;
            const std::int16_t* r = v + (back ? row_ : 0) + (up ? slice_ : 0);
            const float weight = (back ? cell.y : 1 - cell.y) * (up ? cell.z : 1 - cell.z);
            const float right = weight * cell.x, left = weight - right;
            x += left * float(r[1] - r[-1]) + right * float(r[2] - r[0]);
            y += left * float(r[row_] - r[-row_]) + right * float(r[row_ + 1] - r[1 - row_]);
            z += left * float(r[slice_] - r[-slice_]) + right * float(r[slice_ + 1] - r[1 - slice_]);
        }
        return per_voxel_[0] * double(x) + per_voxel_[1] * double(y) + per_voxel_[2] * double(z);
    }

private:
    struct Cell {
        const std::int16_t* first;  // its lowest corner
        float x, y, z;              // the place within it
    };
    Cell cellAt(Place p) const
    {
        const int i = int(p.x), j = int(p.y), k = int(p.z);  // none is negative
        return {voxels_ + i + row_ * j + slice_ * k, p.x - float(i), p.y - float(j), p.z - float(k)};
    }
    float mixed(const std::int16_t* v, float tx, float ty) const
    {
        const float front = float(v[0]) + tx * float(v[1] - v[0]);
        const float back = float(v[row_]) + tx * float(v[row_ + 1] - v[row_]);
        return front + ty * (back - front);
    }

    // Four voxels at once: a row's four, or two rows' two.
    static std::uint64_t four(const std::int16_t* v)
    {
        std::uint64_t voxels = 0;
        std::memcpy(&voxels, v, sizeof voxels);
        return voxels;
    }
    static std::uint64_t pairs(const std::int16_t* v, const std::int16_t* w)
    {
        std::uint32_t a = 0, b = 0;
        std::memcpy(&a, v, sizeof a);
        std::memcpy(&b, w, sizeof b);
        return std::uint64_t{b} << 32U | a;
    }
    // A number is zero where taking one from it borrows into its highest bit, which was not set.
    static bool holdsPadding(std::uint64_t voxels)
    {
        constexpr std::uint64_t kOnes = 0x0001000100010001, kHighest = kOnes << 15U;
        const std::uint64_t rest = voxels ^ kOnes * std::uint16_t(kPaddingHu);
        return ((rest - kOnes) & ~rest & kHighest) != 0;
    }
    bool paddingAround(const std::int16_t* v) const
    {
        const std::int16_t* w = v + slice_;
        for (const std::int16_t* r : {v, v + row_, w, w + row_})
            if (holdsPadding(four(r - 1)))
                return true;
        for (const std::int16_t* r : {v, w})
            if (holdsPadding(pairs(r - row_, r + 2 * row_)))
                return true;
        for (const std::int16_t* r : {v, v + row_})
            if (holdsPadding(pairs(r - slice_, r + 2 * slice_)))
                return true;
        return false;
    }

    Grid grid_;
    const std::int16_t* voxels_;
    std::ptrdiff_t row_, slice_;
    float last_[3];
    Vector3 per_voxel_[3];
};

}  // namespace vicon::viewer

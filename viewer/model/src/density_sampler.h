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
            per_mm_[a] = float(1 / volume.grid.spacing_mm[a]);
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

    /// Whether a place lies between voxels of the scan.
    bool holds(Place p) const
    {
        return p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x < last_[0] && p.y < last_[1] && p.z < last_[2];
    }

    /// False beside padding. `p` must be held by the scan.
    /// @param padding whether some may be near
    bool sample(Place p, bool padding, float& density_hu) const
    {
        const VoxelCube cell = voxelCubeAt(p);
        const std::int16_t *v = cell.first, *w = v + slice_;
        if (padding && (holdsPadding(pairs(v, v + row_)) || holdsPadding(pairs(w, w + row_))))
            return false;
        const float near = mixed(v, cell.x, cell.y), far = mixed(w, cell.x, cell.y);
        density_hu = near + cell.z * (far - near);
        return true;
    }

    /// The gradient of the density, taken over two voxels, of which a ray asks two things.
    struct Slope {
        float along = 0;  ///< its part along the ray, with its sign
        float steep = 0;  ///< its length
    };
    /// From trilinear samples one voxel to either side; zero where one of them is missing. All of them lie in rows of
    /// four voxels around one cell, which are taken as vectors.
    /// @param unit what indexStep() says of the ray's unit direction
    /// @param padding whether some may be near
    Slope slope(Place p, Place unit, bool padding) const
    {
        if (!(p.x >= 1 && p.y >= 1 && p.z >= 1 && p.x < last_[0] - 1 && p.y < last_[1] - 1 && p.z < last_[2] - 1))
            return {};
        const VoxelCube cell = voxelCubeAt(p);
        const std::int16_t* v = cell.first;
        if (padding && paddingAround(v))
            return {};
        const auto row = [&](int j, int k) { return rowOf(v + row_ * j + slice_ * k); };
        const Float4 front = row(0, 0), back = row(1, 0), front_up = row(0, 1), back_up = row(1, 1);
        const Float4 low = front + cell.y * (back - front), high = front_up + cell.y * (back_up - front_up);
        const Float4 across = low + cell.z * (high - low);
        const Float4 deep = mixed(back - row(-1, 0), row(2, 0) - front, cell.y);
        const Float4 deep_up = mixed(back_up - row(-1, 1), row(2, 1) - front_up, cell.y);
        const Float4 under = mixed(front_up - row(0, -1), back_up - row(1, -1), cell.y);
        const Float4 over = mixed(row(0, 2) - front, row(1, 2) - back, cell.y);
        const float x = mixed(across[2] - across[0], across[3] - across[1], cell.x);
        const Float4 y = mixed(deep, deep_up, cell.z), z = mixed(under, over, cell.z);
        const float gy = mixed(y[1], y[2], cell.x), gz = mixed(z[1], z[2], cell.x);
        const float sx = x * per_mm_[0], sy = gy * per_mm_[1], sz = gz * per_mm_[2];
        return {x * unit.x + gy * unit.y + gz * unit.z, std::sqrt(sx * sx + sy * sy + sz * sz)};
    }

private:
    struct VoxelCube {
        const std::int16_t* first;  // its lowest corner
        float x, y, z;              // the place within it
    };
    VoxelCube voxelCubeAt(Place p) const
    {
        const int i = int(p.x), j = int(p.y), k = int(p.z);  // none is negative
        return {voxels_ + i + row_ * j + slice_ * k, p.x - float(i), p.y - float(j), p.z - float(k)};
    }
    using Float4 = float __attribute__((vector_size(16)));
    // The voxel before `v`, it, and two more.
    static Float4 rowOf(const std::int16_t* v)
    {
        using Eight = std::int16_t __attribute__((vector_size(16)));
        using Word4 = std::int32_t __attribute__((vector_size(16)));
        using TwoLong = std::uint64_t __attribute__((vector_size(16)));
        const auto voxels = reinterpret_cast<Eight>(TwoLong{four(v - 1), 0});
        // Each twice, so that the upper half of a word is the voxel; a plain conversion is made one by one.
        const Eight twice = __builtin_shufflevector(voxels, voxels, 0, 0, 1, 1, 2, 2, 3, 3);
        return __builtin_convertvector(reinterpret_cast<Word4>(twice) >> 16, Float4);
    }
    template <class T>
    static T mixed(T a, T b, float share)
    {
        return a + share * (b - a);
    }
    float mixed(const std::int16_t* v, float tx, float ty) const
    {
        const float front = float(v[0]) + tx * float(v[1] - v[0]);
        const float back = float(v[row_]) + tx * float(v[row_ + 1] - v[row_]);
        return front + ty * (back - front);
    }

    // Float4 voxels at once: a row's four, or two rows' two.
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
    float per_mm_[3];
};

}  // namespace vicon::viewer

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "vicon/core/geometry.h"

namespace vicon::steps {

/// Columns that are swept together: one cache line of floats, and whole vector registers.
inline constexpr int kLanes = 16;
/// Where the wall lies before an outside voxel's centre is kept in bytes, in 128ths of a voxel.
inline constexpr float kPlaceUnit = 1.0F / 128;
/// Half-way: where the wall lies when only the mask is known.
inline constexpr std::uint8_t kHalfVoxel = 64;
/// The wall lies at most this far before an outside voxel's centre, in voxels.
inline constexpr float kLargestPlace = 1.9F;
/// The wall distance of outside voxels while sweeping: nothing is nearer.
inline constexpr float kNever = -1000;

using Lanes = std::array<float, kLanes>;

/// What is swept: squared distances to the nearest outside voxel and, where densities tell, the place of the wall
/// before that voxel.
struct Swept {
    Grid grid;
    float* squared;
    std::uint8_t* place;  ///< null: the wall lies half-way everywhere
};

/// kLanes neighbouring columns, with a row of outside before and behind.
template <bool kPlaces>
class ColumnBlock {
public:
    explicit ColumnBlock(int rows)
        : rows_(rows),
          before_(std::size_t(rows) + 2),
          after_(std::size_t(rows)),
          place_(kPlaces ? before_.size() : 0),
          place_after_(kPlaces ? after_.size() : 0)
    {
        if (kPlaces) {
            place_.front().fill(kHalfVoxel);
            place_.back().fill(kHalfVoxel);
        }
    }

    /// Copies `lanes` columns in; false when none of them holds an inside voxel.
    bool load(const Swept& from, std::size_t first, std::size_t row_stride, int lanes)
    {
        float any = 0;
        for (int r = 0; r < rows_; ++r) {
            const std::size_t n = first + std::size_t(r) * row_stride;
            Lanes& row = before_[std::size_t(r) + 1];
            row.fill(0);
            std::copy_n(from.squared + n, lanes, row.begin());
            for (const float value : row)
                any = std::max(any, value);
            if (kPlaces)
                std::copy_n(from.place + n, lanes, place_[std::size_t(r) + 1].begin());
        }
        return any > 0;
    }

    /// after[r] = min over q of before[q] + weight * (r - q)^2. The search of a row ends at the distance found so far,
    /// which is short in a lumen, and all columns search at once; it beats a lower envelope column by column there.
    /// With places, the least distance to the wall itself decides; of two walls equally far, the one farther before its
    /// voxel.
    void sweep(float weight)
    {
        for (int r = 0; r < rows_; ++r) {
            Nearest best{before_[std::size_t(r) + 1], {}, {}};
            if (kPlaces) {
                best.place = place_[std::size_t(r) + 1];
                for (std::size_t l = 0; l < kLanes; ++l)
                    best.wall[l] = best.squared[l] > 0 ? wallAt(best.squared[l], best.place[l]) : kNever;
            }
            float reach = reachOf(best);
            for (int n = 1; reach >= weight * float(n) * float(n); ++n) {
                const float step = weight * float(n) * float(n);
                consider(best, std::size_t(std::max(r + 1 - n, 0)), step);
                consider(best, std::size_t(std::min(r + 1 + n, rows_ + 1)), step);
                if (n % 4 == 0)
                    reach = reachOf(best);
            }
            after_[std::size_t(r)] = best.squared;
            if (kPlaces)
                place_after_[std::size_t(r)] = best.place;
        }
    }

    void store(const Swept& to, std::size_t first, std::size_t row_stride, int lanes) const
    {
        for (int r = 0; r < rows_; ++r) {
            const std::size_t n = first + std::size_t(r) * row_stride;
            std::copy_n(after_[std::size_t(r)].begin(), lanes, to.squared + n);
            if (kPlaces)
                std::transform(place_after_[std::size_t(r)].begin(), place_after_[std::size_t(r)].begin() + lanes,
                               to.place + n, [](float p) { return std::uint8_t(p); });
        }
    }

private:
    /// The best found so far for one row of lanes; `place` and `wall` only with places.
    struct Nearest {
        Lanes squared, place, wall;
    };

    /// Distance of the wall, in voxels; below that of the voxel behind it.
    static float wallAt(float squared, float place) { return std::sqrt(squared) - place * kPlaceUnit; }

    /// The square of the largest distance, along the columns, at which something nearer may still lie.
    static float reachOf(const Nearest& best)
    {
        if (!kPlaces)
            return *std::max_element(best.squared.begin(), best.squared.end());
        const float farthest = *std::max_element(best.wall.begin(), best.wall.end());
        return farthest == kNever ? 0 : (farthest + kLargestPlace) * (farthest + kLargestPlace);
    }

    void consider(Nearest& best, std::size_t row, float step)
    {
        const Lanes& other = before_[row];
        if constexpr (kPlaces) {
            const Lanes& place = place_[row];
            for (std::size_t l = 0; l < kLanes; ++l) {
                const float wall = wallAt(other[l] + step, place[l]);
                const bool better = wall < best.wall[l] || (wall == best.wall[l] && place[l] > best.place[l]);
                best.squared[l] = better ? other[l] + step : best.squared[l];
                best.place[l] = better ? place[l] : best.place[l];
                best.wall[l] = better ? wall : best.wall[l];
            }
        } else {
            for (std::size_t l = 0; l < kLanes; ++l)
                best.squared[l] = std::min(best.squared[l], other[l] + step);
        }
    }

    int rows_;
    std::vector<Lanes> before_, after_, place_, place_after_;
};

/// The same along a row, where all distances are still those of the nearest outside voxel of the row itself.
inline void sweepRow(const std::uint8_t* inside, float* squared, std::uint8_t* place, int count, float weight)
{
    for (int i = 0; i < count;) {
        if (!inside[i]) {
            ++i;
            continue;
        }
        int end = i;
        while (end < count && inside[end])
            ++end;
        const std::uint8_t before = place && i > 0 ? place[i - 1] : kHalfVoxel;
        const std::uint8_t behind = place && end < count ? place[end] : kHalfVoxel;
        for (int v = i; v < end; ++v) {
            const int to_begin = v - i + 1, to_end = end - v;
            const float scale = std::sqrt(weight), lead = float(before - behind) * kPlaceUnit;
            const bool first = float(to_begin - to_end) * scale < lead ||
                               (float(to_begin - to_end) * scale == lead && before > behind);
            const auto d = float(place ? (first ? to_begin : to_end) : std::min(to_begin, to_end));
            squared[v] = weight * d * d;
            if (place)
                place[v] = first ? before : behind;
        }
        i = end;
    }
}

}  // namespace vicon::steps

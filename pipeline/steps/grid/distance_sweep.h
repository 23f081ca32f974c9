#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
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
inline constexpr float kLargestPlace = 1;
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

/// Which stretches of kLanes voxels along the rows hold an inside voxel: a lumen fills a tenth of its box.
class Occupied {
public:
    explicit Occupied(const Grid& grid)
        : stretches_((grid.size[0] + kLanes - 1) / kLanes),
          rows_(grid.size[1]),
          any_(std::size_t(stretches_) * std::size_t(rows_) * std::size_t(grid.size[2]), 0)
    {
    }
    int stretches() const { return stretches_; }
    std::uint8_t& at(int stretch, int j, int k) { return any_[index(stretch, j, k)]; }
    std::uint8_t at(int stretch, int j, int k) const { return any_[index(stretch, j, k)]; }

private:
    std::size_t index(int stretch, int j, int k) const
    {
        return std::size_t(stretch) + std::size_t(stretches_) * (std::size_t(j) + std::size_t(rows_) * std::size_t(k));
    }
    int stretches_, rows_;
    std::vector<std::uint8_t> any_;
};

/// kLanes neighbouring columns from one row of outside voxels to the next.
template <bool kPlaces>
class ColumnBlock {
public:
    explicit ColumnBlock(int rows)
        : before_(std::size_t(rows) + 2),
          after_(std::size_t(rows)),
          place_(kPlaces ? before_.size() : 0),
          place_after_(kPlaces ? after_.size() : 0)
    {
    }

    /// Where in memory the block lies, and how much of it.
    struct Part {
        std::size_t first, stride;  ///< offset of the first row's first voxel; from row to row
        int rows, lanes;
        bool at_begin, at_end;  ///< no row lies before the first, behind the last
    };

    void load(const Swept& from, const Part& part)
    {
        rows_ = part.rows;
        before_[0].fill(0);
        before_[std::size_t(rows_) + 1].fill(0);
        for (int r = 0; r < rows_; ++r) {
            Lanes& row = before_[std::size_t(r) + 1];
            row.fill(0);
            std::copy_n(from.squared + part.first + std::size_t(r) * part.stride, part.lanes, row.begin());
        }
        if constexpr (kPlaces)
            for (int r = -1; r <= rows_; ++r) {
                Lanes& row = place_[std::size_t(r + 1)];
                row.fill(float(kHalfVoxel) * kPlaceUnit);
                if ((r < 0 && part.at_begin) || (r == rows_ && part.at_end))
                    continue;
                const std::uint8_t* place = from.place + part.first + std::size_t(r) * part.stride;
                std::transform(place, place + part.lanes, row.begin(),
                               [](std::uint8_t p) { return float(p) * kPlaceUnit; });
            }
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
                consider(best, {std::size_t(std::max(r + 1 - n, 0)), std::size_t(std::min(r + 1 + n, rows_ + 1))},
                         step);
                if (n % 4 == 0)
                    reach = reachOf(best);
            }
            after_[std::size_t(r)] = best.squared;
            if (kPlaces)
                place_after_[std::size_t(r)] = best.place;
        }
    }

    void store(const Swept& to, const Part& part) const
    {
        for (int r = 0; r < rows_; ++r) {
            const std::size_t n = part.first + std::size_t(r) * part.stride;
            std::copy_n(after_[std::size_t(r)].begin(), part.lanes, to.squared + n);
            if (kPlaces)
                std::transform(place_after_[std::size_t(r)].begin(), place_after_[std::size_t(r)].begin() + part.lanes,
                               to.place + n, [](float p) { return std::uint8_t(p / kPlaceUnit); });
        }
    }

    /// Stores distances of inside voxels: distance(squared, place in voxels).
    template <class Distance>
    void store(const Swept& to, const Part& part, Distance distance) const
    {
        for (int r = 0; r < rows_; ++r) {
            float* row = to.squared + part.first + std::size_t(r) * part.stride;
            const Lanes& squared = after_[std::size_t(r)];
            for (std::size_t l = 0; l < std::size_t(part.lanes); ++l)
                row[l] = squared[l] > 0 ? distance(squared[l], kPlaces ? place_after_[std::size_t(r)][l] : 0) : 0;
        }
    }

private:
    /// The best found so far for one row of lanes; `place` and `wall` only with places.
    struct Nearest {
        Lanes squared, place, wall;
    };

    /// Distance of the wall, in voxels; below that of the voxel behind it.
    static float wallAt(float squared, float place) { return std::sqrt(squared) - place; }

    /// The square of the largest distance, along the columns, at which something nearer may still lie.
    static float reachOf(const Nearest& best)
    {
        if (!kPlaces)
            return *std::max_element(best.squared.begin(), best.squared.end());
        const float farthest = *std::max_element(best.wall.begin(), best.wall.end());
        return farthest == kNever ? 0 : (farthest + kLargestPlace) * (farthest + kLargestPlace);
    }

    void consider(Nearest& best, const std::array<std::size_t, 2>& rows, float step)
    {
        if constexpr (kPlaces) {
            if (!mayBeNearer(best, rows, step))
                return;
            for (const std::size_t row : rows)
                takeNearer(best, before_[row], place_[row], step);
        } else {
            for (const std::size_t row : rows)
                for (std::size_t l = 0; l < kLanes; ++l)
                    best.squared[l] = std::min(best.squared[l], before_[row][l] + step);
        }
    }

    /// Without a root: most rows are not nearer in any lane.
    bool mayBeNearer(const Nearest& best, const std::array<std::size_t, 2>& rows, float step) const
    {
        constexpr float kRounding = 1.00001F;  // more than floats lose in the products below
        const Lanes &before = before_[rows[0]], &behind = before_[rows[1]];
        const Lanes &place_before = place_[rows[0]], &place_behind = place_[rows[1]];
        std::array<int, kLanes> nearer;
        for (std::size_t l = 0; l < kLanes; ++l) {
            const float first = best.wall[l] + place_before[l], second = best.wall[l] + place_behind[l];
            nearer[l] = (int(first > 0) & int(before[l] + step <= first * first * kRounding)) |
                        (int(second > 0) & int(behind[l] + step <= second * second * kRounding));
        }
        return std::any_of(nearer.begin(), nearer.end(), [](int yes) { return yes != 0; });
    }

    // Both sides of every choice are computed, so that the compiler can choose lane by lane in vector registers.
    static void takeNearer(Nearest& best, const Lanes& other, const Lanes& place, float step)
    {
        for (std::size_t l = 0; l < kLanes; ++l) {
            const float squared = other[l] + step, wall = wallAt(squared, place[l]);
            const bool better = int(wall < best.wall[l]) | (int(wall == best.wall[l]) & int(place[l] > best.place[l]));
            best.squared[l] = better ? squared : best.squared[l];
            best.place[l] = better ? place[l] : best.place[l];
            best.wall[l] = better ? wall : best.wall[l];
        }
    }

    int rows_ = 0;
    std::vector<Lanes> before_, after_, place_, place_after_;
};

/// The same along a row, where all distances are still those of the nearest outside voxel of the row itself. Marks
/// the stretches that hold an inside voxel: element n of `occupied` tells of voxels from n * kLanes on.
inline void sweepRow(const std::uint8_t* inside, float* squared, std::uint8_t* place, int count, float weight,
                     std::uint8_t* occupied)
{
    const float scale = std::sqrt(weight);
    for (int i = 0; i < count;) {
        if (!inside[i]) {
            std::uint64_t next = 1;
            if (i + 8 <= count)
                std::memcpy(&next, inside + i, sizeof next);
            i += next ? 1 : 8;
            continue;
        }
        int end = i;
        while (end < count && inside[end])
            ++end;
        const std::uint8_t before = place && i > 0 ? place[i - 1] : kHalfVoxel;
        const std::uint8_t behind = place && end < count ? place[end] : kHalfVoxel;
        for (int v = i; v < end; ++v) {
            const int to_begin = v - i + 1, to_end = end - v;
            const float lead = float(before - behind) * kPlaceUnit;
            const bool first = float(to_begin - to_end) * scale < lead ||
                               (float(to_begin - to_end) * scale == lead && before > behind);
            const auto d = float(place ? (first ? to_begin : to_end) : std::min(to_begin, to_end));
            squared[v] = weight * d * d;
            if (place)
                place[v] = first ? before : behind;
        }
        std::fill(occupied + i / kLanes, occupied + (end - 1) / kLanes + 1, std::uint8_t(1));
        i = end;
    }
}

}  // namespace vicon::steps

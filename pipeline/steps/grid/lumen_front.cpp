#include "grid/lumen_front.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "grid/allocate.h"
#include "grid/neighbours.h"
#include "vicon/core/error.h"
#include "vicon/core/nearest_voxel.h"

namespace vicon::steps {
namespace {

/// Width of a bucket in voxels: narrow enough that few voxels are corrected, wide enough that few buckets are empty.
constexpr float kBucketWidth = 0.5F;
/// Corrections below this part of a voxel are not passed on; they are rounding.
constexpr float kTolerance = 1e-4F;

/// How many voxels ahead of the one at work memory is asked for. Fronts from a whole skeleton run all over the lumen at
/// once, so nothing of what comes next is in a cache. Chosen on the 512 x 512 x 430 phantom; 4 to 16 are as good.
constexpr std::size_t kAhead = 8;

}  // namespace

/// The time t >= all used times with sum ((t - time)/spacing)^2 = 1, over as many neighbours as are earlier than it.
float LumenFront::solveEikonal(std::array<Upwind, 3> up) const
{
    if (up[1].time < up[0].time)
        std::swap(up[0], up[1]);
    if (up[2].time < up[1].time)
        std::swap(up[1], up[2]);
    if (up[1].time < up[0].time)
        std::swap(up[0], up[1]);
    // Times relative to the earliest: floats keep their precision 2 m from the exit.
    const float base = up[0].time, x = up[1].time - base, y = up[2].time - base;
    const float u = per_square_[up[0].axis], v = per_square_[up[1].axis], w = per_square_[up[2].axis];
    if (u * x * x >= 1)  // as late as the second neighbour, the front has passed
        return base + spacing_[up[0].axis];
    float a = u + v, b = v * x, c = v * x * x - 1;
    if (u * y * y + v * (y - x) * (y - x) < 1) {
        a += w;
        b += w * y;
        c += w * y * y;
    }
    return base + (b + std::sqrt(std::max(0.0F, b * b - a * c))) / a;
}

LumenFront::LumenFront(const InsideVolume& inside) : inside_(inside), bricks_(inside)
{
    if (inside.voxels.size() >= std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorCode::no_memory, "the colon's box has more than 4294967295 voxels");
    for (std::size_t d = 0; d < 3; ++d) {
        const auto square = float(inside.grid.spacing_mm[d] * inside.grid.spacing_mm[d]);
        spacing_[d] = std::sqrt(square);
        per_square_[d] = 1 / square;
    }
    const double smallest_mm = *std::min_element(inside.grid.spacing_mm.begin(), inside.grid.spacing_mm.end());
    tolerance_mm_ = kTolerance * float(smallest_mm);
    per_bucket_ = 1 / (kBucketWidth * float(smallest_mm));
    restart();
}

void LumenFront::restart()
{
    fillFresh(time_, bricks_.placeCount(), kOutsideTime);
    using Range = tbb::blocked_range<std::uint32_t>;
    inside_count_ = tbb::parallel_reduce(
        Range(BrickGrid::kVoxels, std::uint32_t(time_.size()), 1 << 14), std::size_t(0),
        [&](const Range& range, std::size_t count) {
            for (std::uint32_t place = range.begin(); place < range.end(); ++place)
                if (inside_.valueOr(bricks_.voxelAt(place), kOutside)) {
                    time_[place] = kUnreached;
                    ++count;
                }
            return count;
        },
        std::plus<>());
    reached_count_ = 0;
    buckets_.clear();
}

void LumenFront::push(std::uint32_t place, std::size_t not_before)
{
    const std::size_t bucket = std::max(bucketOf(place), not_before);
    if (bucket >= buckets_.size())
        buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(place);
}

void LumenFront::seedPlace(std::uint32_t place, float time_mm)
{
    setTime(place, time_mm);
    push(place, 0);
}

void LumenFront::seed(std::size_t voxel, float time_mm)
{
    if (const std::uint32_t place = placeOf(voxel); time_[place] > time_mm)
        seedPlace(place, time_mm);
}

void LumenFront::seed(std::size_t voxel, float time_mm, std::uint16_t label)
{
    const std::uint32_t place = placeOf(voxel);
    if (time_[place] <= time_mm)
        return;
    if (label_.empty())
        fillFresh(label_, time_.size(), kNoLabel);
    label_[place] = label;
    seedPlace(place, time_mm);
}

template <LumenFront::Labels labels>
void LumenFront::relax(std::uint32_t place, std::size_t bucket)
{
    const std::array<std::uint32_t, 6> around = bricks_.around(place);
    std::array<Upwind, 3> up;
    std::uint32_t from = place;
    float earliest = kUnreached;
    for (std::size_t d = 0; d < 3; ++d) {
        up[d] = {kUnreached, std::uint32_t(d)};
        for (const std::uint32_t neighbour : {around[2 * d], around[2 * d + 1]}) {
            const float t = time_[neighbour];
            if (t < 0 || t >= up[d].time)
                continue;
            if (labels == Labels::fixed && std::abs(int(label_[neighbour]) - int(label_[place])) > kSpan)
                continue;
            up[d].time = t;
            if (t < earliest) {
                earliest = t;
                from = neighbour;
            }
        }
    }
    if (earliest == kUnreached)
        return;
    const float t = solveEikonal(up);
    if (t >= time_[place] - tolerance_mm_)
        return;
    setTime(place, t);
    if (labels == Labels::adopt)
        label_[place] = label_[from];
    push(place, bucket);
}

/// Asks for the times and labels that relaxing a voxel's neighbours looks at.
template <LumenFront::Labels labels>
void LumenFront::fetch(std::uint32_t place) const
{
    for (const std::uint32_t neighbour : bricks_.around(place)) {
        __builtin_prefetch(&time_[neighbour]);
        if (labels != Labels::ignore)
            __builtin_prefetch(&label_[neighbour]);
    }
}

template <LumenFront::Labels labels>
void LumenFront::drain()
{
    std::vector<std::uint32_t> current;
    for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
        // What is pushed into this bucket while it is worked off comes next.
        while (!buckets_[bucket].empty()) {
            current.clear();
            std::swap(current, buckets_[bucket]);
            for (std::size_t n = 0; n < current.size(); ++n) {
                const std::uint32_t place = current[n];
                if (n + 2 * kAhead < current.size())
                    bricks_.fetch(current[n + 2 * kAhead]);
                if (n + kAhead < current.size())
                    fetch<labels>(current[n + kAhead]);
                if (bucketOf(place) < bucket)
                    continue;
                const float t = time_[place];
                for (const std::uint32_t neighbour : bricks_.around(place))
                    if (time_[neighbour] > t)
                        relax<labels>(neighbour, bucket);
            }
        }
        std::vector<std::uint32_t>().swap(buckets_[bucket]);
    }
    buckets_.clear();
}

void LumenFront::run(Labels labels)
{
    if (labels == Labels::adopt)
        drain<Labels::adopt>();
    else if (labels == Labels::fixed)
        drain<Labels::fixed>();
    else
        drain<Labels::ignore>();
}

namespace {

/// Calls visit(offset, distance_mm) for the 26 neighbours of a voxel that lie in the grid.
template <class Visit>
void forNeighbours(const Grid& grid, std::size_t voxel, Visit visit)
{
    const Index3 v = grid.indexOf(voxel);
    forEachInCube(v, 1, [&](Index3 n) {
        if (n != v && grid.contains(n))
            visit(grid.offset(n), std::hypot((n.i - v.i) * grid.spacing_mm[0], (n.j - v.j) * grid.spacing_mm[1],
                                             (n.k - v.k) * grid.spacing_mm[2]));
    });
}

}  // namespace

void LumenFront::runOverCorners(Labels labels)
{
    for (std::vector<std::uint32_t> left = unreached(); !left.empty();) {
        struct Step {
            std::uint32_t voxel;
            float time_mm;
            std::uint16_t label;
        };
        std::vector<Step> steps;
        for (const std::uint32_t voxel : left) {
            Step best{voxel, kUnreached, labels == Labels::ignore ? kNoLabel : labelAt(voxel)};
            forNeighbours(grid(), voxel, [&](std::size_t neighbour, double distance_mm) {
                const float t = timeAt(neighbour);
                if (t < 0 || t == kUnreached || t + float(distance_mm) >= best.time_mm)
                    return;
                best.time_mm = t + float(distance_mm);
                if (labels == Labels::adopt)
                    best.label = labelAt(neighbour);
            });
            if (best.time_mm < kUnreached)
                steps.push_back(best);
        }
        if (steps.empty())
            return;
        for (const Step& step : steps) {
            if (labels == Labels::ignore)
                seed(step.voxel, step.time_mm);
            else
                seed(step.voxel, step.time_mm, step.label);
        }
        run(labels);
        std::erase_if(left, [&](std::uint32_t voxel) { return timeAt(voxel) < kUnreached; });
    }
}

std::vector<std::uint32_t> LumenFront::unreached() const
{
    std::vector<std::uint32_t> voxels;
    if (reached_count_ == inside_count_)
        return voxels;
    for (std::uint32_t place = BrickGrid::kVoxels; place < time_.size(); ++place)
        if (time_[place] == kUnreached)
            voxels.push_back(std::uint32_t(grid().offset(bricks_.voxelAt(place))));
    std::sort(voxels.begin(), voxels.end());
    return voxels;
}

std::vector<std::uint32_t> LumenFront::componentOf(std::uint32_t voxel)
{
    seen_.resize(inside_.voxels.size());
    std::vector<std::uint32_t> found{voxel};
    seen_[voxel] = true;
    for (std::size_t n = 0; n < found.size(); ++n)
        forNeighbours(grid(), found[n], [&](std::size_t neighbour, double) {
            if (timeAt(neighbour) != kUnreached || seen_[neighbour])
                return;
            seen_[neighbour] = true;
            found.push_back(std::uint32_t(neighbour));
        });
    for (const std::uint32_t v : found)
        seen_[v] = false;
    return found;
}

/// Hands the values at all places on as those of all voxels; the rest is untouched.
template <class T>
void LumenFront::spread(const std::vector<T>& at_place, std::vector<T>& voxels) const
{
    const auto row = std::size_t(grid().size[0]);
    tbb::parallel_for(0, grid().size[2], [&](int k) {
        for (int j = 0; j < grid().size[1]; ++j)
            bricks_.forEachRun(j, k, [&](int i, std::uint32_t place, int count) {
                std::copy_n(
                    &at_place[place], count,
                    &voxels[std::size_t(i) + row * (std::size_t(j) + std::size_t(grid().size[1]) * std::size_t(k))]);
            });
    });
}

FieldVolume LumenFront::times() const
{
    auto field = makeVolume<float>(grid(), kOutsideTime);
    spread(time_, field.voxels);
    return field;
}

std::vector<std::uint16_t> LumenFront::labels() const
{
    auto all = makeVolume<std::uint16_t>(grid(), kNoLabel);
    if (!label_.empty())
        spread(label_, all.voxels);
    return std::move(all.voxels);
}

std::size_t nearestInside(const InsideVolume& inside, Point3 point)
{
    const auto nearest =
        nearestVoxel(inside.grid, point, kAnyDistance_mm, [&](Index3 v) { return inside.at(v) != kOutside; });
    if (!nearest)
        throw Error(ErrorCode::bad_input, "the mask holds no inside voxel");
    return inside.grid.offset(nearest->voxel);
}

}  // namespace vicon::steps

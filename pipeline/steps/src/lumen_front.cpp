#include "lumen_front.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "allocate.h"

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
    const float base = up[0].time;
    float t = spacing_[up[0].axis];
    float a = per_square_[up[0].axis], b = 0, c = -1;
    for (std::size_t n = 1; n < 3 && up[n].time < base + t; ++n) {
        const float w = per_square_[up[n].axis], x = up[n].time - base;
        a += w;
        b += w * x;
        c += w * x * x;
        const float root = b * b - a * c;
        if (root < 0)
            break;
        t = (b + std::sqrt(root)) / a;
    }
    return base + t;
}

LumenFront::LumenFront(const InsideVolume& inside) : time(makeVolume<float>(inside.grid)), inside_(inside)
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
    using Range = tbb::blocked_range<std::size_t>;
    inside_count_ = tbb::parallel_reduce(
        Range(0, time.voxels.size(), 1 << 18), std::size_t(0),
        [&](const Range& range, std::size_t count) {
            for (std::size_t n = range.begin(); n < range.end(); ++n) {
                time.voxels[n] = inside_.voxels[n] ? kUnreached : kOutsideTime;
                count += inside_.voxels[n] != kOutside;
            }
            return count;
        },
        std::plus<>());
    reached_count_ = 0;
    buckets_.clear();
}

void LumenFront::push(std::uint32_t voxel, float time_mm, std::size_t not_before)
{
    const std::size_t bucket = std::max(bucketOf(time_mm), not_before);
    if (bucket >= buckets_.size())
        buckets_.resize(bucket + 1);
    buckets_[bucket].push_back(voxel);
}

void LumenFront::seed(std::size_t voxel, float time_mm)
{
    if (!inside_.voxels[voxel] || time.voxels[voxel] <= time_mm)
        return;
    setTime(voxel, time_mm);
    push(std::uint32_t(voxel), time_mm, 0);
}

void LumenFront::seed(std::size_t voxel, float time_mm, std::uint16_t a_label)
{
    if (!inside_.voxels[voxel] || time.voxels[voxel] <= time_mm)
        return;
    if (label.empty())
        fillFresh(label, time.voxels.size(), kNoLabel);
    label[voxel] = a_label;
    seed(voxel, time_mm);
}

template <LumenFront::Labels labels>
void LumenFront::relax(std::uint32_t voxel, int i, int j, int k, std::size_t bucket)
{
    const auto& size = inside_.grid.size;
    const std::array<int, 3> at{i, j, k};
    const std::array<std::uint32_t, 3> stride{1, std::uint32_t(size[0]),
                                              std::uint32_t(size[0]) * std::uint32_t(size[1])};
    std::array<Upwind, 3> up;
    std::uint32_t from = voxel;
    float earliest = kUnreached;
    for (std::size_t d = 0; d < 3; ++d) {
        up[d] = {kUnreached, std::uint32_t(d)};
        const auto consider = [&](std::uint32_t neighbour) {
            const float t = time.voxels[neighbour];
            if (t < 0 || t >= up[d].time)
                return;
            if (labels == Labels::fixed && std::abs(int(label[neighbour]) - int(label[voxel])) > kSpan)
                return;
            up[d].time = t;
            if (t < earliest) {
                earliest = t;
                from = neighbour;
            }
        };
        if (at[d] > 0)
            consider(voxel - stride[d]);
        if (at[d] + 1 < size[d])
            consider(voxel + stride[d]);
    }
    if (earliest == kUnreached)
        return;
    const float t = solveEikonal(up);
    if (t >= time.voxels[voxel] - tolerance_mm_)
        return;
    setTime(voxel, t);
    if (labels == Labels::adopt)
        label[voxel] = label[from];
    push(voxel, t, bucket);
}

/// Asks for the rows of times that relaxing a voxel's neighbours looks at.
void LumenFront::fetch(std::uint32_t voxel) const
{
    const auto row = std::ptrdiff_t(inside_.grid.size[0]), slice = row * inside_.grid.size[1];
    const auto count = std::ptrdiff_t(time.voxels.size());
    for (const std::ptrdiff_t step : {std::ptrdiff_t(0), row, -row, slice, -slice, 2 * row, -2 * row, 2 * slice,
                                      -2 * slice, row + slice, row - slice, slice - row, -row - slice})
        if (const std::ptrdiff_t n = std::ptrdiff_t(voxel) + step; n >= 0 && n < count)
            __builtin_prefetch(&time.voxels[std::size_t(n)]);
}

template <LumenFront::Labels labels>
void LumenFront::drain()
{
    const auto nx = std::uint32_t(inside_.grid.size[0]), ny = std::uint32_t(inside_.grid.size[1]);
    const auto nz = std::uint32_t(inside_.grid.size[2]), slice = nx * ny;
    std::vector<std::uint32_t> current;
    for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
        // What is pushed into this bucket while it is worked off comes next.
        while (!buckets_[bucket].empty()) {
            current.clear();
            std::swap(current, buckets_[bucket]);
            for (std::size_t n = 0; n < current.size(); ++n) {
                const std::uint32_t voxel = current[n];
                if (n + kAhead < current.size())
                    fetch(current[n + kAhead]);
                const float t = time.voxels[voxel];
                if (bucketOf(t) < bucket)
                    continue;
                const std::uint32_t k = voxel / slice, in_slice = voxel - k * slice, j = in_slice / nx,
                                    i = in_slice - j * nx;
                const int x = int(i), y = int(j), z = int(k);
                const auto visit = [&](std::uint32_t neighbour, int ni, int nj, int nk) {
                    if (time.voxels[neighbour] > t)
                        relax<labels>(neighbour, ni, nj, nk, bucket);
                };
                if (i > 0)
                    visit(voxel - 1, x - 1, y, z);
                if (i + 1 < nx)
                    visit(voxel + 1, x + 1, y, z);
                if (j > 0)
                    visit(voxel - nx, x, y - 1, z);
                if (j + 1 < ny)
                    visit(voxel + nx, x, y + 1, z);
                if (k > 0)
                    visit(voxel - slice, x, y, z - 1);
                if (k + 1 < nz)
                    visit(voxel + slice, x, y, z + 1);
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
    for (int k = v.k - 1; k <= v.k + 1; ++k)
        for (int j = v.j - 1; j <= v.j + 1; ++j)
            for (int i = v.i - 1; i <= v.i + 1; ++i)
                if (const Index3 n{i, j, k}; n != v && grid.contains(n))
                    visit(grid.offset(n), std::hypot((i - v.i) * grid.spacing_mm[0], (j - v.j) * grid.spacing_mm[1],
                                                     (k - v.k) * grid.spacing_mm[2]));
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
            Step best{voxel, kUnreached, labels == Labels::ignore ? kNoLabel : label[voxel]};
            forNeighbours(grid(), voxel, [&](std::size_t neighbour, double distance_mm) {
                const float t = time.voxels[neighbour];
                if (t < 0 || t == kUnreached || t + float(distance_mm) >= best.time_mm)
                    return;
                best.time_mm = t + float(distance_mm);
                if (labels == Labels::adopt)
                    best.label = label[neighbour];
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
        std::erase_if(left, [&](std::uint32_t voxel) { return time.voxels[voxel] < kUnreached; });
    }
}

std::vector<std::uint32_t> LumenFront::unreached() const
{
    std::vector<std::uint32_t> voxels;
    if (reached_count_ == inside_count_)
        return voxels;
    for (std::size_t n = 0; n < time.voxels.size(); ++n)
        if (time.voxels[n] == kUnreached)
            voxels.push_back(std::uint32_t(n));
    return voxels;
}

std::vector<std::uint32_t> LumenFront::componentOf(std::uint32_t voxel)
{
    seen_.resize(time.voxels.size());
    std::vector<std::uint32_t> found{voxel};
    seen_[voxel] = true;
    for (std::size_t n = 0; n < found.size(); ++n)
        forNeighbours(grid(), found[n], [&](std::size_t neighbour, double) {
            if (time.voxels[neighbour] != kUnreached || seen_[neighbour])
                return;
            seen_[neighbour] = true;
            found.push_back(std::uint32_t(neighbour));
        });
    for (const std::uint32_t v : found)
        seen_[v] = false;
    return found;
}

std::size_t nearestInside(const InsideVolume& inside, Point3 point)
{
    const Grid& grid = inside.grid;
    const Index3 c = grid.indexAt(point);
    const double smallest_mm = *std::min_element(grid.spacing_mm.begin(), grid.spacing_mm.end());
    double best_mm = std::numeric_limits<double>::max();
    std::size_t best = 0;
    const auto clampedRange = [&](int centre, int r, std::size_t d) {
        return std::pair(std::max(centre - r, 0), std::min(centre + r, grid.size[d] - 1));
    };
    int reach = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        const int at = d == 0 ? c.i : d == 1 ? c.j : c.k;
        reach = std::max({reach, at + 1, grid.size[d] - at});
    }
    for (int r = 0; r <= reach && (r - 1) * smallest_mm <= best_mm; ++r) {
        const auto [k0, k1] = clampedRange(c.k, r, 2);
        for (int k = k0; k <= k1; ++k) {
            const auto [j0, j1] = clampedRange(c.j, r, 1);
            for (int j = j0; j <= j1; ++j) {
                const auto [i0, i1] = clampedRange(c.i, r, 0);
                const bool shell = std::abs(k - c.k) == r || std::abs(j - c.j) == r;
                for (int i = i0; i <= i1; ++i) {
                    if (!shell && std::abs(i - c.i) != r) {
                        // Inside the shell: searched already; go on at its far side.
                        i = std::max(i, c.i + r - 1);
                        continue;
                    }
                    const Index3 v{i, j, k};
                    if (!inside.at(v))
                        continue;
                    if (const double d = distance(grid.pointAt(v), point); d < best_mm) {
                        best_mm = d;
                        best = grid.offset(v);
                    }
                }
            }
        }
    }
    if (best_mm == std::numeric_limits<double>::max())
        throw Error(ErrorCode::bad_input, "the mask holds no inside voxel");
    return best;
}

}  // namespace vicon::steps

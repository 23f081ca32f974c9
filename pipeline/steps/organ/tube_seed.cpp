#include "organ/tube_seed.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grid/run_labels.h"

namespace vicon::steps {
namespace {

// Chosen on phantoms 1 and 2 of both organs.
constexpr double kLeastFill = 0.85;      // of the ellipse with the same moments
constexpr double kMostElongation = 1.8;  // of that ellipse
constexpr double kNear = 0.7;            // of the radius: from the middle of one slice to the next
constexpr double kSameRadius = 1.5;

/// A round section of something.
struct Disc {
    double x = 0, y = 0;  ///< voxels
    double radius = 0;    ///< voxels
    int below = -1;       ///< the disc of the next slice towards the feet that it goes on as
    int length = 1;       ///< slices, down to the end
};

struct Moments {
    double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

/// The round ones of a slice's components.
std::vector<Disc> discsOf(const RunLabels& labels, double least_radius, double most_radius)
{
    std::vector<Moments> moments(labels.components.size());
    for (int j = 0; j < labels.size[1]; ++j)
        for (std::size_t r = labels.row_begin[std::size_t(j)]; r < labels.row_begin[std::size_t(j) + 1]; ++r) {
            Moments& m = moments[labels.runs[r].label];
            for (int i = labels.runs[r].begin; i < labels.runs[r].end; ++i) {
                m.n += 1;
                m.x += i;
                m.y += j;
                m.xx += double(i) * i;
                m.yy += double(j) * j;
                m.xy += double(i) * j;
            }
        }
    std::vector<Disc> discs;
    for (const Moments& m : moments) {
        const double radius = std::sqrt(m.n / std::numbers::pi);
        if (radius < least_radius || radius > most_radius)
            continue;
        const double x = m.x / m.n, y = m.y / m.n, xx = m.xx / m.n - x * x + 1.0 / 12,
                     yy = m.yy / m.n - y * y + 1.0 / 12, xy = m.xy / m.n - x * y;
        const double half = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy);
        const double large = half + apart, small = std::max(1e-9, half - apart);
        const double fill = m.n / (4 * std::numbers::pi * std::sqrt(large * small));
        if (fill >= kLeastFill && std::sqrt(large / small) <= kMostElongation)
            discs.push_back({x, y, radius});
    }
    return discs;
}

/// Joins each disc to the one below it that leads farthest.
void join(std::vector<Disc>& upper, const std::vector<Disc>& lower)
{
    for (Disc& disc : upper)
        for (std::size_t n = 0; n < lower.size(); ++n) {
            const Disc& next = lower[n];
            const double ratio = std::max(disc.radius / next.radius, next.radius / disc.radius);
            if (ratio > kSameRadius || std::hypot(disc.x - next.x, disc.y - next.y) > kNear * disc.radius)
                continue;
            if (next.length + 1 > disc.length) {
                disc.length = next.length + 1;
                disc.below = int(n);
            }
        }
}

}  // namespace

SeedTube findSeedTube(const HuVolume& volume, const Body& body, const OrganOptions& options, Progress& progress)
{
    const Grid& grid = volume.grid;
    const double voxel_mm = grid.spacing_mm[0];
    const double middle_x = (body.lower_mm.x + body.upper_mm.x) / 2,
                 off_mm = options.seed_off_midline * (body.upper_mm.x - body.lower_mm.x);
    std::vector<std::vector<Disc>> slices(std::size_t(grid.size[2]), std::vector<Disc>{});
    tbb::parallel_for(0, grid.size[2], [&](int k) {
        const auto scan = [&](int j, int, std::vector<VoxelRun>& runs) {
            const std::int16_t* hu = &volume.voxels[grid.offset({0, j, k})];
            const std::size_t first = runs.size();
            for (int i = 0; i < grid.size[0]; ++i) {
                if (hu[i] < options.low_hu || hu[i] > options.high_hu || !body.holds(j, k, i / body.factor))
                    continue;
                if (runs.size() == first || runs.back().end != i)
                    runs.push_back({i, i, 0, 0});
                ++runs.back().end;
            }
        };
        auto& discs = slices[std::size_t(k)];
        discs = discsOf(labelRuns({grid.size[0], grid.size[1], 1}, scan, Neighbours::faces),
                        options.seed_from_radius_mm / voxel_mm, options.seed_to_radius_mm / voxel_mm);
        std::erase_if(discs, [&](const Disc& disc) {
            return std::abs(grid.pointAt(ContinuousIndex3{disc.x, disc.y, double(k)}).x - middle_x) > off_mm;
        });
    });
    progress.check();
    int best_k = -1;
    std::size_t best = 0;
    for (int k = 0; k < grid.size[2]; ++k) {
        auto& discs = slices[std::size_t(k)];
        if (k > 0)
            join(discs, slices[std::size_t(k) - 1]);
        for (std::size_t n = 0; n < discs.size(); ++n)
            if (best_k < 0 || discs[n].length >= slices[std::size_t(best_k)][best].length) {
                best_k = k;
                best = n;
            }
    }
    SeedTube tube;
    if (best_k < 0)
        return tube;
    for (int k = best_k, n = int(best); n >= 0; --k) {
        const Disc& disc = slices[std::size_t(k)][std::size_t(n)];
        tube.middle_mm.push_back(grid.pointAt(ContinuousIndex3{disc.x, disc.y, double(k)}));
        tube.radius_mm += disc.radius * voxel_mm;
        n = disc.below;
    }
    tube.radius_mm /= double(tube.middle_mm.size());
    tube.length_mm = double(tube.middle_mm.size()) * grid.spacing_mm[2];
    if (tube.length_mm < options.seed_length_mm)
        tube.middle_mm.clear();
    return tube;
}

}  // namespace vicon::steps

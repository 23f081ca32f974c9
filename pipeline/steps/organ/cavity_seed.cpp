#include "organ/cavity_seed.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "grid/run_labels.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::steps {
namespace {

// No case recorded; on the stomachs of phantoms 31 and 32 the next widest is 0.6 as wide.
constexpr double kNearlyAsWide = 0.8;  // of the widest ball's radius: which of the two is meant, a person says

/// What of the body has the organ's densities, on the body's grid.
InsideVolume wanted(const Body& body, const OrganOptions& options)
{
    InsideVolume mask(body.inside.grid);
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
        if (body.inside.voxels[n] && body.mean_hu.voxels[n] >= options.low_hu &&
            body.mean_hu.voxels[n] <= options.high_hu)
            mask.voxels[n] = kGas;
    return mask;
}

struct Widest {
    float radius_mm = 0;
    Index3 voxel;
};

/// The widest ball of each connected part, by the part's number; those with their middle too far off the midline, and
/// too narrow or too wide ones, are none.
std::vector<Widest> widestOfParts(const InsideVolume& mask, const Body& body, const OrganOptions& options,
                                  Progress& progress)
{
    const FieldVolume wall_mm = wallDistance(mask, progress);
    const RunLabels parts = labelLumen(mask, Neighbours::faces);
    const double middle_x = (body.lower_mm.x + body.upper_mm.x) / 2,
                 off_mm = options.seed_off_midline * (body.upper_mm.x - body.lower_mm.x);
    std::vector<Widest> widest(parts.components.size());
    const auto widen = [&](Widest& best, const VoxelRun& run, int j, int k) {
        for (int i = run.begin; i < run.end; ++i) {
            const Index3 v{i, j, k};
            if (wall_mm.at(v) > best.radius_mm && std::abs(mask.grid.pointAt(v).x - middle_x) <= off_mm)
                best = {wall_mm.at(v), v};
        }
    };
    for (int k = 0; k < mask.grid.size[2]; ++k)
        for (int j = 0; j < mask.grid.size[1]; ++j)
            for (std::size_t r = parts.row_begin[parts.row(j, k)]; r < parts.row_begin[parts.row(j, k) + 1]; ++r)
                widen(widest[parts.runs[r].label], parts.runs[r], j, k);
    std::erase_if(widest, [&](const Widest& ball) {
        return double(ball.radius_mm) < options.seed_from_radius_mm ||
               double(ball.radius_mm) > options.seed_to_radius_mm;
    });
    return widest;
}

}  // namespace

std::optional<SeedBall> findSeedBall(const Body& body, const OrganOptions& options, Progress& progress)
{
    const InsideVolume mask = wanted(body, options);
    std::vector<Widest> balls = widestOfParts(mask, body, options, progress);
    if (balls.empty())
        return std::nullopt;
    std::stable_sort(balls.begin(), balls.end(),
                     [](const Widest& a, const Widest& b) { return a.radius_mm > b.radius_mm; });
    SeedBall found{mask.grid.pointAt(balls[0].voxel), double(balls[0].radius_mm), {}};
    if (balls.size() > 1 && double(balls[1].radius_mm) >= kNearlyAsWide * found.radius_mm)
        found.other_mm = mask.grid.pointAt(balls[1].voxel);
    return found;
}

void keepLargestPart(InsideVolume& mask)
{
    const RunLabels parts = labelLumen(mask, Neighbours::faces);
    const auto largest =
        std::max_element(parts.components.begin(), parts.components.end(),
                         [](const RunComponent& a, const RunComponent& b) { return a.voxels < b.voxels; });
    const auto kept = std::uint32_t(largest - parts.components.begin());
    parts.forEachRun([&](const VoxelRun& run, int j, int k) {
        if (run.label != kept)
            std::fill_n(&mask.at({run.begin, j, k}), run.end - run.begin, std::uint8_t(kOutside));
    });
}

}  // namespace vicon::steps

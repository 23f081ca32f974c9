#include "wall_stations.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "vicon/core/nearest_voxel.h"

namespace vicon::viewer {
namespace {

constexpr double kSweepStep_mm = 1;
constexpr double kNearVoxel_mm = 4;  // a wall lies within a voxel of the lumen; the path may run outside of it
// How far the nearest place may be from the one that is as far from the exit. The way along the inside of a bend is
// shorter than the path by a few centimetres in the tightest, which the next straight stretch takes back.
constexpr double kStationReach_mm = 30;

std::optional<float> exitAt(Point3 p, const FieldView& exit_distance)
{
    const Index3 here = exit_distance.grid.indexAt(p);
    if (const float value = exit_distance.valueOr(here, -1); value >= 0)
        return value;
    const auto nearest =
        nearestVoxel(exit_distance.grid, p, kNearVoxel_mm, [&](Index3 v) { return exit_distance.at(v) >= 0; });
    return nearest ? std::optional(exit_distance.at(nearest->voxel)) : std::nullopt;
}

/// How far from the exit the path is at each step; where it runs outside the lumen, as from one side to the other.
std::vector<float> exitAlong(const PathFrames& path, const FieldView& exit_distance)
{
    std::vector<float> along;
    std::vector<std::size_t> open;  // not known yet
    const int steps = int(std::ceil(path.length_mm() / kSweepStep_mm));
    for (int n = 0; n <= steps; ++n) {
        const auto value = exitAt(path.at(n * kSweepStep_mm).position_mm, exit_distance);
        const float before = along.empty() ? 0 : along.back();
        along.push_back(std::max(before, value.value_or(before)));
        if (!value) {
            open.push_back(along.size() - 1);
            continue;
        }
        for (std::size_t k = 0; k < open.size(); ++k)
            along[open[k]] = std::lerp(before, along.back(), float(k + 1) / float(open.size() + 1));
        open.clear();
    }
    return along;
}

double stationOf(Point3 p, double around_mm, const PathFrames& path)
{
    const double station = path.nearestStation(p, around_mm, kStationReach_mm);
    const bool first = station <= 0, last = station >= path.length_mm();
    if (!first && !last)
        return station;
    const PathFrame end = path.at(station);
    const double beyond = dot(p - end.position_mm, end.forward);
    return station + (first ? std::min(beyond, 0.0) : std::max(beyond, 0.0));
}

}  // namespace

std::vector<float> stationsOfWall(const CellSurface& surface, const PathFrames& path, const FieldView& exit_distance,
                                  Progress& progress)
{
    const std::vector<float> along = exitAlong(path, exit_distance);
    const bool has_normals = surface.normals.size() == surface.points_mm.size();
    const double into_lumen_mm = exit_distance.grid.spacing_mm[0] / 2;
    std::vector<float> stations(surface.pointCount());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, stations.size(), 4096), [&](const auto& some) {
        if (progress.cancelled())
            return;
        for (std::size_t n = some.begin(); n < some.end(); ++n) {
            const Point3 p = surface.point(n);
            const float* v = has_normals ? &surface.normals[3 * n] : nullptr;
            const Vector3 inwards = v ? Vector3{v[0], v[1], v[2]} : Vector3{};
            const auto exit = exitAt(p + inwards * into_lumen_mm, exit_distance);
            const auto found = std::lower_bound(along.begin(), along.end(), exit.value_or(0));
            const double around = double(std::min(found, along.end() - 1) - along.begin()) * kSweepStep_mm;
            stations[n] = float(stationOf(p, around, path));
        }
    });
    progress.check();
    return stations;
}

}  // namespace vicon::viewer

#include "vicon/steps/cells.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "grid/neighbours.h"
#include "grid/wall_values.h"
#include "subdivide/contour.h"
#include "tissue/lumen_of_tissue.h"
#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

/// Where the densities' gradient is further than this from the surface's own normal (cosine), it belongs to something
/// else, a fluid level or a neighbouring loop, and the surface's normal is taken.
constexpr double kAgree = 0.5;

/// The segment of an inside voxel, or of the nearest one beside it where the wall lies farther out than the labels.
std::uint16_t segmentAt(const SegmentVolume& segments, Index3 v)
{
    std::uint16_t found = segments.valueOr(v, 0);
    for (int reach = 1; found == 0 && reach <= 3; ++reach) {
        int nearest2 = std::numeric_limits<int>::max();
        forEachInCube(v, reach, [&](Index3 w) {
            const int i = w.i - v.i, j = w.j - v.j, k = w.k - v.k, away2 = i * i + j * j + k * k;
            if (const std::uint16_t segment = segments.valueOr(w, 0); segment != 0 && away2 < nearest2) {
                nearest2 = away2;
                found = segment;
            }
        });
    }
    return found;
}

/// The segment of each triangle: that of the inside voxel, among those its corners belong to, nearest to its middle.
std::vector<std::uint16_t> tagTriangles(const Contour& contour, const InsideVolume& inside,
                                        const SegmentVolume& segments)
{
    std::vector<std::uint16_t> tags(contour.triangleCount());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tags.size(), 4096), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
            const std::uint32_t* corners = &contour.triangles[3 * t];
            double middle[3] = {};
            for (std::size_t n = 0; n < 3; ++n)
                for (std::size_t d = 0; d < 3; ++d)
                    middle[d] += double(contour.points[3 * std::size_t(corners[n]) + d]) / 3;
            double nearest = std::numeric_limits<double>::max();
            for (std::size_t n = 0; n < 3; ++n) {
                const Index3 v = voxelsNear(contour, corners[n], inside).voxels[0];
                const double away = std::hypot(v.i - middle[0], v.j - middle[1], v.k - middle[2]);
                if (away < nearest) {
                    nearest = away;
                    tags[t] = segmentAt(segments, v);
                }
            }
        }
    });
    return tags;
}

Vector3 toPatient(const Grid& grid, Vector3 per_voxel)
{
    return grid.axis[0] * (per_voxel.x / grid.spacing_mm[0]) + grid.axis[1] * (per_voxel.y / grid.spacing_mm[1]) +
           grid.axis[2] * (per_voxel.z / grid.spacing_mm[2]);
}

/// The low 16 bits with two zeros before each.
std::uint64_t spread(std::uint64_t x)
{
    x &= 0xFFFF;
    x = (x | x << 16) & 0x0000FF0000FFULL;
    x = (x | x << 8) & 0x00F00F00F00FULL;
    x = (x | x << 4) & 0x0C30C30C30C3ULL;
    return (x | x << 2) & 0x249249249249ULL;
}

/// Triangles by segment, and within a segment along a curve that fills space (Morton's order of their first corners):
/// any run of them is a compact patch.
std::vector<std::uint32_t> drawingOrder(const Contour& contour, const std::vector<std::uint16_t>& tags)
{
    struct Place {
        std::uint64_t key;
        std::uint32_t triangle;
        bool operator<(const Place& other) const
        {
            return key != other.key ? key < other.key : triangle < other.triangle;
        }
    };
    // Counted from the surface's own corner, so that it does not matter how closely the grid is cropped.
    std::array<float, 3> low{1e9F, 1e9F, 1e9F};
    for (std::size_t n = 0; n < contour.points.size(); ++n)
        low[n % 3] = std::min(low[n % 3], std::floor(contour.points[n]));
    std::vector<Place> places(tags.size());
    for (std::uint32_t t = 0; t < tags.size(); ++t) {
        const float* p = &contour.points[3 * std::size_t(contour.triangles[3 * std::size_t(t)])];
        const auto at = [&](std::size_t d) { return spread(std::uint64_t(std::floor(p[d]) - low[d])); };
        places[t] = {std::uint64_t(tags[t]) << 48 | at(0) | at(1) << 1 | at(2) << 2, t};
    }
    tbb::parallel_sort(places.begin(), places.end());
    std::vector<std::uint32_t> order(tags.size());
    for (std::size_t n = 0; n < places.size(); ++n)
        order[n] = places[n].triangle;
    return order;
}

/// Puts triangles in drawing order and points in order of their first use, in patient coordinates.
CellSurface arrange(const Contour& contour, const std::vector<std::uint16_t>& tags, const Grid& grid,
                    std::vector<std::uint32_t>& point_source)
{
    const std::vector<std::uint32_t> order = drawingOrder(contour, tags);
    constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();  // a corner of no triangle yet
    std::vector<std::uint32_t> renumbered(contour.pointCount(), kUnused);
    CellSurface surface;
    surface.triangles.reserve(contour.triangles.size());
    surface.segment.reserve(tags.size());
    const bool right_handed = dot(cross(grid.axis[0], grid.axis[1]), grid.axis[2]) > 0;
    for (const std::uint32_t t : order) {
        surface.segment.push_back(tags[t]);
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t p = contour.triangles[3 * std::size_t(t) + (right_handed ? n : 2 - n)];
            if (renumbered[p] == kUnused) {
                renumbered[p] = std::uint32_t(point_source.size());
                point_source.push_back(p);
            }
            surface.triangles.push_back(renumbered[p]);
        }
    }
    surface.points_mm.reserve(3 * point_source.size());
    for (const std::uint32_t p : point_source) {
        const float* c = &contour.points[3 * std::size_t(p)];
        const Point3 at = grid.pointAt(ContinuousIndex3{c[0], c[1], c[2]});
        for (const double x : {at.x, at.y, at.z})
            surface.points_mm.push_back(float(x));
    }
    return surface;
}

/// Area-weighted normals of the triangles around each point; they point to the front side.
std::vector<Vector3> surfaceNormals(const CellSurface& surface)
{
    std::vector<Vector3> normals(surface.pointCount());
    for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
        const std::uint32_t* c = &surface.triangles[3 * t];
        const Point3 p = surface.point(c[0]);
        const Vector3 area = cross(surface.point(c[1]) - p, surface.point(c[2]) - p);
        for (int n = 0; n < 3; ++n)
            normals[c[n]] += area;
    }
    return normals;
}

/// The direction towards the lumen that the field around a point of the contour tells, without length where it tells
/// none.
using NormalAt = std::function<Vector3(const NearVoxels&)>;

/// The sum of the voxels' own directions by what each counts.
template <class Gradient>
Vector3 meanOver(const NearVoxels& around, Gradient gradient)
{
    Vector3 sum = gradient(around.voxels[0]) * around.weights[0];
    for (std::size_t n = 1; n < around.count; ++n)
        sum += gradient(around.voxels[n]) * around.weights[n];
    return sum;
}

NormalAt fromDensities(const WallField& field, const InsideVolume& inside)
{
    return [&](const NearVoxels& around) {
        const Index3 v = around.voxels[0];
        if (!field.densitiesTell(v))
            return Vector3{};
        return meanOver(around, [&](Index3 n) { return field.gradient(n); }) * (inside.at(v) == kGas ? -1 : 1);
    };
}

NormalAt fromTissue(const TissueVolume& tissue)
{
    return [&](const NearVoxels& around) {
        return meanOver(around, [&](Index3 n) { return tissueGradient(tissue, n); }) * -1;
    };
}

void setNormals(CellSurface& surface, const Contour& contour, const std::vector<std::uint32_t>& point_source,
                const NormalAt& towardsLumen, const InsideVolume& inside)
{
    const auto geometric = surfaceNormals(surface);
    surface.normals.resize(surface.points_mm.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, point_source.size(), 4096), [&](const auto& range) {
        for (std::size_t n = range.begin(); n < range.end(); ++n) {
            const NearVoxels around = voxelsNear(contour, point_source[n], inside);
            Vector3 normal = normalized(toPatient(inside.grid, towardsLumen(around)));
            const Vector3 own = normalized(geometric[n]);
            if (dot(normal, own) < kAgree)
                normal = own;
            surface.normals[3 * n] = float(normal.x);
            surface.normals[3 * n + 1] = float(normal.y);
            surface.normals[3 * n + 2] = float(normal.z);
        }
    });
}

}  // namespace

struct LumenSurface::Parts {
    const InsideVolume* lumen = nullptr;
    std::optional<WallField> field;
    NormalAt normal_at;
    Contour contour;
    std::vector<NearWall> near_wall;

    void make(Volume<std::int16_t>& values)
    {
        near_wall = findNearWall(values, *lumen);
        contour = contourOf(values);
    }
};

LumenSurface::LumenSurface(const HuVolume& hu, const InsideVolume& inside, const WallDensities& densities,
                           Progress& progress)
{
    progress.report(0, "surface");
    auto parts = std::make_unique<Parts>();
    parts->lumen = &inside;
    parts->field.emplace(hu, inside, densities);
    parts->normal_at = fromDensities(*parts->field, inside);
    auto values = wallValues(*parts->field, inside);
    parts->make(values);
    parts_ = std::move(parts);
    progress.check();
    progress.report(1, "surface");
}

LumenSurface::LumenSurface(const TissueVolume& tissue, const InsideVolume& lumen, Progress& progress)
{
    if (tissue.grid != lumen.grid)
        throw Error(ErrorCode::bad_input, "the fraction of tissue does not lie on the grid of the labels", {},
                    "run 'vicon work' to make it anew");
    progress.report(0, "surface");
    auto parts = std::make_unique<Parts>();
    parts->lumen = &lumen;
    parts->normal_at = fromTissue(tissue);
    auto values = tissueValues(tissue, lumen);
    parts->make(values);
    divideAtRims(values, parts->contour);
    parts_ = std::move(parts);
    progress.check();
    progress.report(1, "surface");
}

LumenSurface::~LumenSurface() = default;
LumenSurface::LumenSurface(LumenSurface&&) noexcept = default;
LumenSurface& LumenSurface::operator=(LumenSurface&&) noexcept = default;

const std::vector<NearWall>& LumenSurface::nearWall() const
{
    return parts_->near_wall;
}

CellSurface LumenSurface::cellsOf(const SegmentVolume& segments, Progress& progress) const
{
    const InsideVolume& inside = *parts_->lumen;
    if (segments.grid != inside.grid)
        throw Error(ErrorCode::bad_input, "the segments do not lie on the grid of the labels", {},
                    "run 'vicon work' to make them anew");
    progress.report(0, "surface");
    const auto tags = tagTriangles(parts_->contour, inside, segments);
    std::vector<std::uint32_t> point_source;
    CellSurface surface = arrange(parts_->contour, tags, inside.grid, point_source);
    progress.check();
    progress.report(0.6, "surface");
    setNormals(surface, parts_->contour, point_source, parts_->normal_at, inside);
    progress.report(1, "surface");
    return surface;
}

CellSurface extractCells(const HuVolume& hu, const InsideVolume& inside, const SegmentVolume& segments,
                         const WallDensities& densities, Progress& progress)
{
    return LumenSurface(hu, inside, densities, progress).cellsOf(segments, progress);
}

void countTriangles(const CellSurface& surface, Subdivision& description)
{
    for (auto& segment : description.segments)
        segment.triangles = 0;
    for (const std::uint16_t number : surface.segment)
        if (number >= 1 && number <= description.segments.size())
            ++description.segments[number - 1U].triangles;
    std::size_t largest = 0, smallest = surface.triangleCount();
    double square = 0;
    const double average =
        double(surface.triangleCount()) / double(std::max<std::size_t>(1, description.segments.size()));
    for (const auto& segment : description.segments) {
        largest = std::max(largest, segment.triangles);
        smallest = std::min(smallest, segment.triangles);
        square += std::pow(double(segment.triangles) - average, 2);
    }
    const auto cells = double(std::max<std::size_t>(1, description.segments.size()));
    description.statistics["triangles"] = surface.triangleCount();
    description.statistics["triangles_average"] = average;
    description.statistics["triangles_largest"] = largest;
    description.statistics["triangles_smallest"] = smallest;
    description.statistics["triangles_standard_deviation"] = std::sqrt(square / cells);
}

}  // namespace vicon::steps

#include "vicon/viewer/model/band_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "band_angle.h"
#include "even_out.h"
#include "lay_down.h"
#include "nearest_on_triangle.h"
#include "wall_stations.h"

namespace vicon::viewer {
namespace {

constexpr double kPi = std::numbers::pi;
// The width follows the colon's, but not fold by fold: that would bend what is straight.
constexpr double kRadiusOver_mm = 25;
// Of the median: a huge caecum shall not make all of the band small.
constexpr double kLeastRadius = 0.5, kMostRadius = 1.6;
constexpr double kAreaOver_mm = 3;
// Over how much wall places are evened out, so that the band does not tear where the wall's nearest place on the path
// leaps, and what leans over is laid down. Chosen among 2, 4, 9 and 14 on ctc-prone: below 14 there are holes where the
// wall of a narrow place does not go around the path.
constexpr double kEven_mm = 14;

/// Where a point lies as seen from the path, in the plane across it: up and to the right.
struct OffPath {
    double up_mm, right_mm;
    double radius_mm() const { return std::hypot(up_mm, right_mm); }
};

OffPath offPathAt(const PathFrames& path, double station_mm, Point3 p)
{
    const PathFrame frame = path.at(station_mm);
    const Vector3 d = p - frame.position_mm;
    return {dot(d, frame.up), dot(d, cross(frame.forward, frame.up))};
}

template <class Do>
void forEachPoint(std::size_t count, Do what)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& some) {
        for (std::size_t n = some.begin(); n < some.end(); ++n)
            what(n);
    });
}

double median(std::vector<double> values)
{
    if (values.empty())
        return 1;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Each value the mean of those around it, weighted by a bell.
std::vector<double> smoothed(const std::vector<double>& values, double over)
{
    const int reach = int(std::ceil(2.5 * over));
    std::vector<double> out(values.size());
    for (int n = 0; n < int(values.size()); ++n) {
        double sum = 0, weights = 0;
        for (int m = std::max(0, n - reach); m <= std::min(int(values.size()) - 1, n + reach); ++m) {
            const double weight = std::exp(-0.5 * (m - n) * (m - n) / (over * over));
            sum += weight * values[std::size_t(m)];
            weights += weight;
        }
        out[std::size_t(n)] = sum / weights;
    }
    return out;
}

}  // namespace

BandMap::BandMap(const CellSurface& surface, const PathFrames& path, const FieldView& exit_distance, Progress& progress)
    : surface_(&surface),
      path_(&path),
      station_mm_(stationsOfWall(surface, path, exit_distance, progress)),
      around_rad_(surface.pointCount()),
      depth_mm_(surface.pointCount()),
      area_factor_(surface.pointCount(), 1)
{
    const SurfaceNeighbors neighbors(surface);
    evenOut(station_mm_, 1, neighbors, kEven_mm, progress);
    // Angles have no mean where they go once around; the points of a circle have one.
    std::vector<float> circle(2 * surface.pointCount());
    forEachPoint(surface.pointCount(), [&](std::size_t n) {
        const OffPath across = offPathAt(path, station_mm_[n], surface.point(n));
        depth_mm_[n] = float(across.radius_mm());
        const double radius = std::max(across.radius_mm(), 1e-6);
        circle[2 * n] = float(across.up_mm / radius);
        circle[2 * n + 1] = float(across.right_mm / radius);
    });
    evenOut(circle, 2, neighbors, kEven_mm, progress);
    forEachPoint(surface.pointCount(),
                 [&](std::size_t n) { around_rad_[n] = float(std::atan2(circle[2 * n + 1], circle[2 * n])); });
    layDown(station_mm_, around_rad_, surface, neighbors, progress);
    if (!station_mm_.empty()) {
        const auto [least, most] = std::minmax_element(station_mm_.begin(), station_mm_.end());
        first_mm_ = *least;
        last_mm_ = *most;
    }
    findRadii();
    std::vector<float> areas = areasOfPoints();
    evenOut(areas, 2, neighbors, kAreaOver_mm, progress);
    forEachPoint(surface.pointCount(),
                 [&](std::size_t n) { area_factor_[n] = areas[2 * n] / std::max(areas[2 * n + 1], 1e-9F); });
}

/// The mean distance of the wall from the path, from millimetre to millimetre.
void BandMap::findRadii()
{
    std::vector<double> sums(std::size_t(std::ceil(path_->length_mm())) + 1, 0), counts(sums.size(), 0);
    for (std::size_t n = 0; n < station_mm_.size(); ++n) {
        const auto at = std::size_t(std::clamp(double(station_mm_[n]), 0.0, path_->length_mm()));
        sums[at] += depth_mm_[n];
        counts[at] += 1;
    }
    std::vector<double> known;
    for (std::size_t n = 0; n < sums.size(); ++n)
        if (counts[n] > 0)
            known.push_back(sums[n] / counts[n]);
    const double usual = median(known);
    radius_mm_.resize(sums.size());
    for (std::size_t n = 0; n < sums.size(); ++n)
        radius_mm_[n] =
            std::clamp(counts[n] > 0 ? sums[n] / counts[n] : usual, kLeastRadius * usual, kMostRadius * usual);
    radius_mm_ = smoothed(radius_mm_, kRadiusOver_mm);
}

std::vector<float> BandMap::areasOfPoints()
{
    std::vector<float> areas(2 * surface_->pointCount(), 0);
    double whole = 0, folded = 0;
    for (std::size_t t = 0; t < surface_->triangleCount(); ++t) {
        const auto corners = cornersOf(t);
        const auto x = [&](std::size_t c) { return corners[c].station_mm; };
        const auto y = [&](std::size_t c) { return corners[c].around_rad * radiusAt_mm(corners[c].station_mm); };
        const std::uint32_t* p = &surface_->triangles[3 * t];
        const Point3 a = surface_->point(p[0]), b = surface_->point(p[1]), c = surface_->point(p[2]);
        const double wall_mm2 = length(cross(b - a, c - a)) / 2;
        const double flat_mm2 = ((x(1) - x(0)) * (y(2) - y(0)) - (y(1) - y(0)) * (x(2) - x(0))) / 2;
        whole += wall_mm2;
        if (flat_mm2 < 0)  // its front, which is seen from inside, would be seen from behind
            folded += wall_mm2;
        for (std::size_t k = 0; k < 3; ++k) {
            areas[2 * std::size_t(p[k])] += float(std::abs(flat_mm2));
            areas[2 * std::size_t(p[k]) + 1] += float(wall_mm2);
        }
    }
    turned_share_ = whole > 0 ? folded / whole : 0;
    return areas;
}

double BandMap::radiusAt_mm(double station_mm) const
{
    const double at = std::clamp(station_mm, 0.0, double(radius_mm_.size() - 1));
    const std::size_t n = std::min(std::size_t(at), radius_mm_.size() - 1),
                      next = std::min(n + 1, radius_mm_.size() - 1);
    return std::lerp(radius_mm_[n], radius_mm_[next], at - double(n));
}

std::array<BandPlace, 3> BandMap::cornersOf(std::size_t triangle) const
{
    std::array<BandPlace, 3> corners;
    const std::uint32_t* p = &surface_->triangles[3 * triangle];
    for (std::size_t k = 0; k < 3; ++k) {
        const double around = around_rad_[p[k]];
        corners[k] = {station_mm_[p[k]],
                      k == 0 ? around : corners[0].around_rad + turned(around - corners[0].around_rad)};
    }
    const double middle = (corners[0].around_rad + corners[1].around_rad + corners[2].around_rad) / 3;
    const double back = turned(middle) - middle;
    for (BandPlace& corner : corners)
        corner.around_rad += back;
    return corners;
}

BandPlace BandMap::placeOf(Point3 p) const
{
    constexpr double kTriangle_mm = 4;  // no triangle of a surface contoured on clinical voxels is as long
    double nearest_mm = 1e300;
    for (std::size_t n = 0; n < surface_->pointCount(); ++n)
        nearest_mm = std::min(nearest_mm, distance(surface_->point(n), p));
    double least_mm = 1e300;
    BandPlace best;
    for (std::size_t t = 0; t < surface_->triangleCount(); ++t) {
        const std::uint32_t* corner = &surface_->triangles[3 * t];
        const Point3 a = surface_->point(corner[0]);
        if (distance(a, p) > nearest_mm + kTriangle_mm)
            continue;
        const Point3 b = surface_->point(corner[1]), c = surface_->point(corner[2]);
        const Point3 foot = nearestOnTriangle(p, a, b, c);
        if (distance(foot, p) >= least_mm)
            continue;
        least_mm = distance(foot, p);
        const Vector3 normal = cross(b - a, c - a);
        const double whole = std::max(dot(normal, normal), 1e-30);
        const double of_a = dot(cross(b - foot, c - foot), normal) / whole,
                     of_b = dot(cross(c - foot, a - foot), normal) / whole;
        best = {};
        const auto places = cornersOf(t);
        const std::array weights{of_a, of_b, 1 - of_a - of_b};
        for (std::size_t k = 0; k < 3; ++k) {
            best.station_mm += weights[k] * places[k].station_mm;
            best.around_rad += weights[k] * places[k].around_rad;
        }
        best.around_rad = turned(best.around_rad);
    }
    return best;
}

}  // namespace vicon::viewer

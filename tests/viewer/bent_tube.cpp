#include "bent_tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "test_surface.h"
#include "vicon/steps/exit_distance.h"

namespace vicon::viewer::test {
namespace {

constexpr double kStraight_mm = 60, kVoxel_mm = 0.8;
constexpr double kPi = std::numbers::pi;

/// In the plane z = 0: up along x = -radius, around, down along x = radius.
Point3 courseAt(double station_mm, double bend_mm)
{
    const double bend_length = kPi * bend_mm;
    if (station_mm < kStraight_mm)
        return {-bend_mm, station_mm - kStraight_mm, 0};
    if (station_mm > kStraight_mm + bend_length)
        return {bend_mm, -(station_mm - kStraight_mm - bend_length), 0};
    const double turn = (station_mm - kStraight_mm) / bend_mm;
    return {-bend_mm * std::cos(turn), bend_mm * std::sin(turn), 0};
}

struct Nearest {
    double distance_mm, station_mm;
};

Nearest nearestOn(Point3 p, double bend_mm)
{
    const double length_mm = 2 * kStraight_mm + kPi * bend_mm;
    if (p.y >= 0) {
        const double turn = std::atan2(p.y, -p.x), across = std::hypot(p.x, p.y) - bend_mm;
        return {std::hypot(across, p.z), kStraight_mm + turn * bend_mm};
    }
    const double down = std::min(-p.y, kStraight_mm), beyond = -p.y - down;
    const double left = std::hypot(p.x + bend_mm, p.z, beyond), right = std::hypot(p.x - bend_mm, p.z, beyond);
    return left < right ? Nearest{left, kStraight_mm - down} : Nearest{right, length_mm - kStraight_mm + down};
}

}  // namespace

BentTube::BentTube(double bend_radius_mm, double tube_radius_mm, const std::vector<TubePolyp>& polyps,
                   double polyp_radius_mm, bool folds)
{
    const double length_mm = 2 * kStraight_mm + kPi * bend_radius_mm;
    SkeletonPiece piece;
    for (double s = 0; s <= length_mm; s += 1)
        piece.points.push_back({courseAt(s, bend_radius_mm), s, tube_radius_mm});
    skeleton.pieces = {piece};
    for (const TubePolyp& polyp : polyps) {
        const double turn = kPi * polyp.along_bend;
        const Vector3 inwards{std::cos(turn), -std::sin(turn), 0};
        const Vector3 to_polyp = inwards * std::cos(polyp.around_rad) + Vector3{0, 0, 1} * std::sin(polyp.around_rad);
        polyps_mm.push_back(courseAt(kStraight_mm + turn * bend_radius_mm, bend_radius_mm) + to_polyp * tube_radius_mm);
    }
    const auto radiusAt = [&](double station_mm) {
        constexpr double kEvery_mm = 24, kFold_mm = 5;
        const double wave = std::cos(2 * kPi * station_mm / kEvery_mm);
        return tube_radius_mm - (folds ? kFold_mm * std::pow(std::max(0.0, wave), 10) : 0);
    };
    const auto field = [&](Point3 p) {
        const Nearest nearest = nearestOn(p, bend_radius_mm);
        double value = nearest.distance_mm - radiusAt(nearest.station_mm);
        for (const Point3 polyp : polyps_mm)
            value = std::max(value, polyp_radius_mm - distance(p, polyp));
        return value;
    };
    const double half_x = bend_radius_mm + tube_radius_mm + 4, half_z = tube_radius_mm + 4;
    const double low_y = -kStraight_mm - tube_radius_mm - 4, high_y = bend_radius_mm + tube_radius_mm + 4;
    Grid grid;
    grid.spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm};
    grid.origin_mm = {-half_x, low_y, -half_z};
    grid.size = {int(2 * half_x / kVoxel_mm) + 1, int((high_y - low_y) / kVoxel_mm) + 1,
                 int(2 * half_z / kVoxel_mm) + 1};
    std::vector<float> values(grid.voxelCount());
    InsideVolume inside(grid, kOutside);
    for (std::size_t n = 0; n < values.size(); ++n) {
        values[n] = float(field(grid.pointAt(grid.indexOf(n))));
        if (values[n] < 0)
            inside.voxels[n] = kGas;
    }
    surface = surfaceOf(grid, values, field, [](Point3) { return 1; });
    NoProgress quiet;
    exit_distance = steps::exitDistance(inside, skeleton, quiet);
}

}  // namespace vicon::viewer::test

#include "test_colon.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "test_surface.h"
#include "vicon/scan_files/cells_file.h"
#include "vicon/scan_files/projections_file.h"
#include "vicon/scan_files/skeleton_file.h"
#include "vicon/scan_files/subdivision_file.h"
#include "vicon/scan_files/volume_file.h"
#include "vicon/steps/projections.h"
#include "vicon/steps/wall_distance.h"

namespace vicon::viewer::test {
namespace {

constexpr double kSegment_mm = 30;
constexpr double kPolypRadius_mm = 4;
constexpr double kWallHu = 40, kAirHu = -1000, kFatHu = -90;
constexpr double kBlur_mm = 1.5, kFat_mm = 8;
constexpr double kReach_mm = 24;      // beyond it from the curve there is only fat
constexpr double kPolypShare = 0.27;  // of the curve's length: on the way up, on the patient's left

// LPS: left +x, back +y, head +z.
const std::vector<Point3> kCourse{{0, 30, -78},  {8, 28, -62}, {30, 24, -52},  {50, 16, -36}, {56, 10, -10},
                                  {55, 4, 22},   {46, -8, 50}, {25, -20, 60},  {0, -24, 56},  {-25, -20, 60},
                                  {-46, -8, 50}, {-55, 4, 22}, {-56, 10, -10}, {-53, 12, -45}};

Point3 spline(const std::vector<Point3>& p, double t)
{
    const int last = int(p.size()) - 1;
    const int n = std::clamp(int(t), 0, last - 1);
    const double u = t - n;
    const auto at = [&](int m) { return p[std::size_t(std::clamp(m, 0, last))]; };
    const Point3 a = at(n - 1), b = at(n), c = at(n + 1), d = at(n + 2);
    const auto mix = [&](double w, double x, double y, double z) {
        return 0.5 * (2 * x + (y - w) * u + (2 * w - 5 * x + 4 * y - z) * u * u + (3 * x - w - 3 * y + z) * u * u * u);
    };
    return {mix(a.x, b.x, c.x, d.x), mix(a.y, b.y, c.y, d.y), mix(a.z, b.z, c.z, d.z)};
}

Skeleton curve()
{
    SkeletonPiece piece;
    constexpr int kFine = 14;
    for (int n = 0; n <= (int(kCourse.size()) - 1) * kFine; ++n) {
        const Point3 p = spline(kCourse, double(n) / kFine);
        const double station =
            piece.points.empty() ? 0 : piece.points.back().station_mm + distance(p, piece.points.back().position_mm);
        piece.points.push_back({p, station, 0});
    }
    return {{piece}};
}

// Signed distance, roughly: below 0 in the lumen.
struct Body {
    Skeleton skeleton;
    Point3 polyp;

    double radius(double station) const
    {
        const double wave = std::cos(2 * std::numbers::pi * station / 22);
        return 12 - 3.5 * std::pow(std::max(0.0, wave), 8);
    }
    double field(Point3 p) const { return field(p, skeleton.nearest(p)); }
    double field(Point3 p, const SkeletonFoot& foot) const
    {
        const double tube = foot.distance_mm - radius(foot.station_mm);
        return std::max(tube, kPolypRadius_mm - distance(p, polyp));
    }
};

Body bodyOf()
{
    Body body{curve(), {}};
    const double station = kPolypShare * body.skeleton.length_mm();
    const Vector3 tangent = body.skeleton.tangentAt(station);
    const Vector3 aside = normalized(cross(tangent, {0, 1, 0}));
    body.polyp = body.skeleton.at(station).position_mm + aside * (body.radius(station) - 1);
    return body;
}

// Nearest points of the curve, where they are within kReach_mm: piece by piece, each for the voxels around it.
std::vector<SkeletonFoot> feetOf(const Grid& grid, const Skeleton& skeleton)
{
    SkeletonFoot none;
    none.distance_mm = 1e300;
    std::vector<SkeletonFoot> feet(grid.voxelCount(), none);
    const auto& points = skeleton.pieces.front().points;
    const int reach = int(kReach_mm / grid.spacing_mm[0]) + 2;
    for (std::size_t s = 0; s + 1 < points.size(); ++s) {
        const Point3 a = points[s].position_mm;
        const Vector3 ab = points[s + 1].position_mm - a;
        const Index3 middle = grid.indexAt(a);
        for (int k = middle.k - reach; k <= middle.k + reach; ++k)
            for (int j = middle.j - reach; j <= middle.j + reach; ++j)
                for (int i = middle.i - reach; i <= middle.i + reach; ++i) {
                    if (!grid.contains({i, j, k}))
                        continue;
                    const Point3 p = grid.pointAt(Index3{i, j, k});
                    const double t = std::clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
                    SkeletonFoot& best = feet[grid.offset({i, j, k})];
                    if (const double d = distance(p, a + ab * t); d < best.distance_mm)
                        best = {std::lerp(points[s].station_mm, points[s + 1].station_mm, t), d, a + ab * t, false};
                }
    }
    return feet;
}

Grid gridFor(const Storage& storage, double voxel_mm)
{
    const Vector3 half{80, 52, 96};  // of the box that the body needs
    Grid grid;
    grid.axis = storage.axis;
    grid.spacing_mm = {voxel_mm, voxel_mm, voxel_mm};
    Vector3 corner;
    for (std::size_t a = 0; a < 3; ++a) {
        const Vector3 d = grid.axis[a];
        const double reach = std::abs(d.x) * half.x + std::abs(d.y) * half.y + std::abs(d.z) * half.z;
        grid.size[a] = int(std::ceil(2 * reach / voxel_mm)) + 1;
        corner += d * (-(grid.size[a] - 1) * voxel_mm / 2);
    }
    grid.origin_mm = Point3{} + corner;
    return grid;
}

Point3 boxCorner(Point3 centre, const std::array<Vector3, 3>& frame, const std::array<double, 6>& reach, int n)
{
    static constexpr int kAround[4][2]{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const int side = n / 4;
    return centre + frame[0] * reach[std::size_t(kAround[n % 4][0])] +
           frame[1] * reach[std::size_t(2 + kAround[n % 4][1])] + frame[2] * reach[std::size_t(4 + side)];
}

}  // namespace

std::vector<Storage> storages()
{
    const Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    const double c = std::cos(0.3), s = std::sin(0.3);
    return {{"head first supine", {x, y, z}},
            {"head first prone", {-x, -y, z}},
            {"feet first supine", {-x, y, -z}},
            {"feet first prone", {x, -y, -z}},
            {"slices stored from the head", {x, y, -z}},
            {"oblique", {Vector3{c, s, 0}, Vector3{-s * c, c * c, s}, Vector3{s * s, -c * s, c}}}};
}

TestColon::TestColon(const Storage& storage, double voxel_mm)
    : volume(gridFor(storage, voxel_mm), std::int16_t(kFatHu)),
      inside(volume.grid),
      exit_distance(volume.grid, -1),
      segments(volume.grid)
{
    const Body body = bodyOf();
    skeleton = body.skeleton;
    polyp_mm = body.polyp;
    polyp_radius_mm = kPolypRadius_mm;
    polyp_station_mm = kPolypShare * skeleton.length_mm();
    const Grid& grid = volume.grid;
    std::vector<float> values(volume.voxels.size(), float(kReach_mm));
    const std::vector<SkeletonFoot> feet = feetOf(grid, skeleton);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
        if (feet[n].distance_mm >= kReach_mm)
            continue;
        const double f = body.field(grid.pointAt(grid.indexOf(n)), feet[n]);
        values[n] = float(f);
        const double air = std::clamp(0.5 - f / (2 * kBlur_mm), 0.0, 1.0);
        const double tissue = f > kFat_mm ? kFatHu : kWallHu;
        volume.voxels[n] = std::int16_t(std::lround(air * kAirHu + (1 - air) * tissue));
        if (f < 0) {
            inside.voxels[n] = kGas;
            segments.voxels[n] = std::uint16_t(1 + int(feet[n].station_mm / kSegment_mm));
            exit_distance.voxels[n] = float(feet[n].station_mm);
        }
    }
    NoProgress quiet;
    wall_distance = steps::wallDistance(inside, volume, quiet);
    for (SkeletonPoint& p : skeleton.pieces.front().points)
        p.radius_mm = body.radius(p.station_mm);
    cells = surfaceOf(
        grid, values, [&](Point3 p) { return body.field(p); },
        [&](Point3 p) { return 1 + int(skeleton.nearest(p).station_mm / kSegment_mm); });
    subdivision.method = SubdivideMethod::flood;
    subdivision.portals = portalsOf(segments);
}

void TestColon::write(const std::filesystem::path& folder) const
{
    using scan_files::Packing;
    std::filesystem::create_directories(folder);
    scan_files::writeVolume(folder / "volume.mha", volume, Packing::raw);
    scan_files::writeVolume(folder / "inside.mha", inside, Packing::raw);
    scan_files::writeVolume(folder / "wall_distance.mha", wall_distance, Packing::raw);
    scan_files::writeVolume(folder / "exit_distance.mha", exit_distance, Packing::raw);
    scan_files::writeVolume(folder / "segments.mha", segments, Packing::raw);
    scan_files::writeSkeleton(folder / "skeleton.vtp", skeleton);
    scan_files::writeCells(folder / "cells.vtp", cells);
    scan_files::writeSubdivision(folder / "subdivision.json", subdivision);
    NoProgress quiet;
    scan_files::writeProjections(folder / "projections", steps::project(cells, {}, quiet));
}

FieldVolume wallDistanceOf(const InsideVolume& inside)
{
    const Grid& g = inside.grid;
    std::vector<double> squared(inside.voxels.size());
    for (std::size_t n = 0; n < squared.size(); ++n)
        squared[n] = inside.voxels[n] == kOutside ? 0 : 1e12;
    const std::size_t stride[3]{1, std::size_t(g.size[0]), std::size_t(g.size[0]) * std::size_t(g.size[1])};
    for (std::size_t a = 0; a < 3; ++a) {
        const auto count = std::size_t(g.size[a]);
        const double h2 = g.spacing_mm[a] * g.spacing_mm[a];
        std::vector<double> line(count);
        for (std::size_t n = 0; n < squared.size(); ++n) {
            if (n / stride[a] % count != 0)
                continue;
            for (std::size_t i = 0; i < count; ++i)
                line[i] = squared[n + i * stride[a]];
            for (std::size_t i = 0; i < count; ++i) {
                double& best = squared[n + i * stride[a]];
                for (std::size_t d = 1; d < count && h2 * double(d * d) < best; ++d) {
                    if (i >= d)
                        best = std::min(best, line[i - d] + h2 * double(d * d));
                    if (i + d < count)
                        best = std::min(best, line[i + d] + h2 * double(d * d));
                }
            }
        }
    }
    FieldVolume field(g);
    for (std::size_t n = 0; n < squared.size(); ++n)
        if (squared[n] > 0)
            field.voxels[n] = float(std::sqrt(squared[n]) - g.spacing_mm[0] / 2);
    return field;
}

std::vector<Portal> portalsOf(const SegmentVolume& segments)
{
    const Grid& g = segments.grid;
    std::map<std::pair<int, int>, std::vector<std::pair<Point3, Vector3>>> faces;
    for (std::size_t n = 0; n < segments.voxels.size(); ++n) {
        const Index3 v = g.indexOf(n);
        for (int m = 1; m < 27; ++m) {  // neighbours in all 26 directions, each pair once
            const Index3 w{v.i + m % 3 - 1, v.j + m / 3 % 3 - 1, v.k + m / 9 - 1};
            const int a = segments.at(v), b = segments.valueOr(w, 0);
            if (a != 0 && a < b)
                faces[{a, b}].push_back({interpolate(g.pointAt(v), g.pointAt(w), 0.5), g.pointAt(w) - g.pointAt(v)});
        }
    }
    std::vector<Portal> portals;
    const double diagonal = std::hypot(g.spacing_mm[0], g.spacing_mm[1], g.spacing_mm[2]);
    for (const auto& [pair, list] : faces) {
        Portal portal;
        portal.segment_a = pair.first;
        portal.segment_b = pair.second;
        Vector3 sum, way;
        for (const auto& [p, d] : list) {
            sum += p - Point3{};
            way += d;
        }
        portal.centre_mm = Point3{} + sum / double(list.size());
        portal.normal = length(way) > 0 ? normalized(way) : Vector3{0, 0, 1};
        const Vector3 u =
            normalized(cross(portal.normal, std::abs(portal.normal.x) < 0.9 ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
        const std::array<Vector3, 3> frame{u, cross(portal.normal, u), portal.normal};
        std::array<double, 6> reach{};
        for (const auto& [p, d] : list)
            for (std::size_t a = 0; a < 3; ++a) {
                const double c = dot(p - portal.centre_mm, frame[a]);
                reach[2 * a] = std::min(reach[2 * a], c - diagonal);
                reach[2 * a + 1] = std::max(reach[2 * a + 1], c + diagonal);
            }
        for (int n = 0; n < 8; ++n)
            portal.box_mm[std::size_t(n)] = boxCorner(portal.centre_mm, frame, reach, n);
        std::copy_n(portal.box_mm.begin(), 4, portal.gate_mm.begin());
        portals.push_back(portal);
    }
    return portals;
}

}  // namespace vicon::viewer::test

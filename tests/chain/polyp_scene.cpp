#include "polyp_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/tissue.h"

namespace vicon {
namespace {

constexpr double kGasHu = -1000, kTissueHu = 40, kFluidHu = 500, kVoxel_mm = 0.7;
constexpr Vector3 kGravity{0, 1, 0};
constexpr int kFine = 2;  // samples of a voxel's edge

/// The scene in its own frame: the wall at z = 0, tissue below, the polyp around the z axis.
class Solid {
public:
    explicit Solid(const PolypScene& scene) : scene_(scene), radius_mm_(scene.diameter_mm / 2) {}

    double base_mm() const { return scene_.wall == WallShape::fold ? kFoldHeight_mm : 0; }
    double top_mm() const
    {
        switch (scene_.shape) {
            case PolypShape::sessile:
                return base_mm() + radius_mm_;
            case PolypShape::flat:
                return base_mm() + flatHeight_mm();
            case PolypShape::stalked:
                return base_mm() + stalk_mm() + 2 * radius_mm_;
        }
        return 0;
    }
    bool isTissue(Point3 p) const
    {
        return isWall(p) || isPolyp(p) ||
               (scene_.apart > 0 && isPolyp(p - Vector3{scene_.apart * scene_.diameter_mm, 0, 0}));
    }

    Point3 placeInHead(std::mt19937& random) const
    {
        const double lowest_mm = base_mm() + (scene_.shape == PolypShape::stalked ? stalk_mm() : 0);
        const double half_mm = scene_.longer * radius_mm_;
        std::uniform_real_distribution<double> aside(-half_mm, half_mm), up(lowest_mm, top_mm());
        for (;;)
            if (const Point3 p{aside(random), aside(random), up(random)}; isPolyp(p))
                return p;
    }
    /// Until where a line over the head from its top is out of the wall, and how wide it is there; the stalk apart.
    double widest_mm(double angle) const
    {
        constexpr int kSteps = 720;
        double most = 0;
        for (int n = 0; n <= kSteps; ++n) {
            const double down = std::numbers::pi * n / kSteps, out = radius_mm_ * std::sin(down);
            const Point3 p{scene_.longer * out * std::cos(angle), out * std::sin(angle),
                           headMiddle_mm() + headHeight_mm() * std::cos(down)};
            if (isWall(p))
                break;
            most = std::max(most, 2 * std::hypot(p.x, p.y));
        }
        return most;
    }
    /// Of the head out of the wall.
    double volume_ml() const
    {
        constexpr int kSteps = 80;
        const Vector3 half{scene_.longer * radius_mm_, radius_mm_, headHeight_mm()};
        const auto at = [](int n) { return (n + 0.5) * 2 / kSteps - 1; };
        std::size_t inside = 0;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j)
                for (int k = 0; k < kSteps; ++k) {
                    const Point3 p{half.x * at(i), half.y * at(j), headMiddle_mm() + half.z * at(k)};
                    inside += at(i) * at(i) + at(j) * at(j) + at(k) * at(k) < 1 && !isWall(p) ? 1 : 0;
                }
        return double(inside) * 8 * half.x * half.y * half.z / std::pow(kSteps, 3) / 1000;
    }

private:
    static constexpr double kTubeRadius_mm = 18, kBend_mm = 40, kFoldHeight_mm = 8, kFoldHalf_mm = 1.5, kStalk_mm = 5;
    static constexpr double kRoom = 0.8;  // a tube's radius over what stands in it, at least

    double headMiddle_mm() const
    {
        return base_mm() + (scene_.shape == PolypShape::stalked ? stalk_mm() + radius_mm_ : 0);
    }
    double headHeight_mm() const { return scene_.shape == PolypShape::flat ? flatHeight_mm() : radius_mm_; }
    double flatHeight_mm() const { return std::min(3.0, scene_.diameter_mm / 3); }
    double stalk_mm() const { return kStalk_mm; }
    double tubeRadius_mm() const { return std::max(kTubeRadius_mm, kRoom * top_mm()); }
    /// Of a tube around a circle in the plane of x and z.
    bool isOutsideOfBend(Point3 p, double middle_mm) const
    {
        return std::hypot(std::hypot(p.x, p.z - middle_mm) - kBend_mm, p.y) > tubeRadius_mm();
    }
    bool isWall(Point3 p) const
    {
        switch (scene_.wall) {
            case WallShape::plane:
                return p.z < 0;
            case WallShape::tube:
                return std::hypot(p.y, p.z - tubeRadius_mm()) > tubeRadius_mm();
            case WallShape::outside_bend:
                return isOutsideOfBend(p, tubeRadius_mm() + kBend_mm);
            case WallShape::inside_bend:
                return isOutsideOfBend(p, tubeRadius_mm() - kBend_mm);
            case WallShape::fold:
                return p.z < 0 || (std::abs(p.x) < kFoldHalf_mm && p.z < kFoldHeight_mm);
        }
        return false;
    }
    bool isPolyp(Point3 p) const
    {
        p.x /= scene_.longer;
        const double z = p.z - base_mm();
        switch (scene_.shape) {
            case PolypShape::sessile:
                return p.x * p.x + p.y * p.y + z * z < radius_mm_ * radius_mm_;
            case PolypShape::flat:
                return (p.x * p.x + p.y * p.y) / (radius_mm_ * radius_mm_) + std::pow(z / flatHeight_mm(), 2) < 1;
            case PolypShape::stalked: {
                const double head = z - stalk_mm() - radius_mm_, across = std::hypot(p.x, p.y);
                return across * across + head * head < radius_mm_ * radius_mm_ ||
                       (z > 0 && head < 0 && across < std::min(2.0, 0.5 * radius_mm_));
            }
        }
        return false;
    }

    const PolypScene& scene_;
    double radius_mm_;
};

Vector3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return normalized({normal(random), normal(random), normal(random)});
}

/// Between the scan and the scene's own frame.
struct Place {
    Vector3 x, y, z;
    Point3 origin;

    Place(std::mt19937& random, double middle_mm)
    {
        std::uniform_real_distribution<double> within(-kVoxel_mm / 2, kVoxel_mm / 2);
        z = randomDirection(random);
        x = normalized(cross(z, randomDirection(random)));
        y = cross(z, x);
        origin = Point3{within(random), within(random), within(random)} - z * middle_mm;
    }
    Point3 toScene(Point3 p) const { return {dot(p - origin, x), dot(p - origin, y), dot(p - origin, z)}; }
    Point3 toScan(Point3 p) const { return origin + x * p.x + y * p.y + z * p.z; }
};

void blurAlong(std::vector<float>& values, int count, std::size_t stride, double sigma)
{
    const int reach = int(std::ceil(3.5 * sigma));
    std::vector<float> weights, line(static_cast<std::size_t>(count));
    float sum = 0;
    for (int d = -reach; d <= reach; ++d) {
        weights.push_back(float(std::exp(-d * d / (2 * sigma * sigma))));
        sum += weights.back();
    }
    const auto length = std::size_t(count);
    for (std::size_t n = 0; n < values.size(); ++n) {
        if (n / stride % length != 0)
            continue;
        for (std::size_t c = 0; c < length; ++c)
            line[c] = values[n + c * stride];
        for (int c = 0; c < count; ++c) {
            float mean = 0;
            for (int d = -reach; d <= reach; ++d)
                mean += weights[std::size_t(d + reach)] * line[std::size_t(std::clamp(c + d, 0, count - 1))];
            values[n + std::size_t(c) * stride] = mean / sum;
        }
    }
}

struct Scanned {
    HuVolume hu;
    InsideVolume inside;
};

Scanned scanned(const PolypScene& scene, const Solid& solid, const Place& place, int size, std::mt19937& random)
{
    const double half_mm = (size - 1) * kVoxel_mm / 2;
    const Grid grid{.size = {size, size, size},
                    .origin_mm = {-half_mm, -half_mm, -half_mm},
                    .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}};
    const int fine = kFine * size;
    const auto row = std::size_t(fine), slice = row * row;
    const auto isFluid = [&](Point3 p) { return dot(p - Point3{}, kGravity) > scene.fluid_from_mm; };
    std::vector<float> clean(slice * row);
    for (std::size_t n = 0; n < clean.size(); ++n) {
        const ContinuousIndex3 at{double(n % row) / kFine, double(n / row % row) / kFine, double(n / slice) / kFine};
        const Point3 p = grid.pointAt(at);
        clean[n] = float(solid.isTissue(place.toScene(p)) ? kTissueHu : isFluid(p) ? kFluidHu : kGasHu);
    }
    for (const std::size_t stride : {std::size_t(1), row, slice})
        blurAlong(clean, fine, stride, scene.blur_mm / kVoxel_mm * kFine);
    Scanned scan{HuVolume(grid), InsideVolume(grid, kOutside)};
    const bool has_fluid = std::isfinite(scene.fluid_from_mm);
    std::normal_distribution<double> noise(0, std::max(scene.noise_hu, 1e-9));
    for (std::size_t n = 0; n < scan.hu.voxels.size(); ++n) {
        const Index3 v = grid.indexOf(n);
        const auto i = std::size_t(kFine * v.i), j = std::size_t(kFine * v.j), k = std::size_t(kFine * v.k);
        const double hu = double(clean[i + row * j + slice * k]) + (scene.noise_hu > 0 ? noise(random) : 0);
        scan.hu.voxels[n] = std::int16_t(std::lround(hu));
        const Point3 p = grid.pointAt(v);
        if (has_fluid ? !solid.isTissue(place.toScene(p)) : hu < (kGasHu + kTissueHu) / 2)
            scan.inside.voxels[n] = isFluid(p) ? kFluid : kGas;
    }
    return scan;
}

}  // namespace

PolypTruth truthOf(const PolypScene& scene)
{
    constexpr int kDirections = 36;
    const Solid solid(scene);
    PolypTruth truth{0, solid.volume_ml()};
    for (int n = 0; n < kDirections; ++n)
        truth.diameter_mm = std::max(truth.diameter_mm, solid.widest_mm(std::numbers::pi * n / kDirections));
    return truth;
}

PolypOnWall wallOf(const PolypScene& scene)
{
    constexpr double kAround_mm = 9;
    std::mt19937 random(scene.seed);
    const Solid solid(scene);
    const Place place(random, solid.top_mm() / 2);
    const double wide_mm = scene.diameter_mm * std::max(scene.longer, 1 + 2 * scene.apart);
    const int size = int((std::max(wide_mm, solid.top_mm()) + 2 * kAround_mm) / kVoxel_mm);
    const Scanned scan = scanned(scene, solid, place, size, random);
    NoProgress quiet;
    steps::TissueResult found =
        steps::findTissue(scan.hu, scan.inside, kGravity, {}, std::max(10.0, scene.noise_hu), quiet);
    const SegmentVolume one(scan.hu.grid, 1);
    CellSurface surface = steps::LumenSurface(found.tissue, found.lumen, quiet).cellsOf(one, quiet);
    PolypOnWall wall{std::move(surface), std::move(found.lumen), {}, {}, place.x, place.z};
    std::normal_distribution<double> aside(0, scene.diameter_mm / 10);
    const Point3 meant = place.toScan({aside(random), aside(random), solid.top_mm()});
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < wall.surface.pointCount(); ++n)
        if (const double d = distance(wall.surface.point(n), meant); d < nearest) {
            nearest = d;
            wall.click_mm = wall.surface.point(n);
        }
    constexpr int kPlaces = 2;
    for (int n = 0; n < kPlaces; ++n)
        wall.in_head_mm.push_back(place.toScan(solid.placeInHead(random)));
    return wall;
}

}  // namespace vicon

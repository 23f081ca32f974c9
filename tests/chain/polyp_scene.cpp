#include "polyp_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vicon/core/progress.h"
#include "vicon/core/volume.h"
#include "vicon/steps/cells.h"
#include "vicon/steps/tissue.h"

namespace vicon {
namespace {

constexpr double kGasHu = -1000, kTissueHu = 40, kVoxel_mm = 0.7;
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
    bool isTissue(Point3 p) const { return isWall(p) || isPolyp(p); }
    Point3 placeInHead(std::mt19937& random) const
    {
        const double lowest_mm = base_mm() + (scene_.shape == PolypShape::stalked ? stalk_mm() : 0);
        std::uniform_real_distribution<double> aside(-radius_mm_, radius_mm_), up(lowest_mm, top_mm());
        for (;;)
            if (const Point3 p{aside(random), aside(random), up(random)}; isPolyp(p))
                return p;
    }

private:
    static constexpr double kTubeRadius_mm = 18, kFoldHeight_mm = 8, kFoldHalf_mm = 1.5, kStalk_mm = 5;

    double flatHeight_mm() const { return std::min(3.0, scene_.diameter_mm / 3); }
    double stalk_mm() const { return kStalk_mm; }
    bool isWall(Point3 p) const
    {
        switch (scene_.wall) {
            case WallShape::plane:
                return p.z < 0;
            case WallShape::tube:
                return std::hypot(p.y, p.z - kTubeRadius_mm) > kTubeRadius_mm;
            case WallShape::fold:
                return p.z < 0 || (std::abs(p.x) < kFoldHalf_mm && p.z < kFoldHeight_mm);
        }
        return false;
    }
    bool isPolyp(Point3 p) const
    {
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

HuVolume scanned(const PolypScene& scene, const Solid& solid, const Place& place, int size, std::mt19937& random)
{
    const double half_mm = (size - 1) * kVoxel_mm / 2;
    const Grid grid{.size = {size, size, size},
                    .origin_mm = {-half_mm, -half_mm, -half_mm},
                    .spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm}};
    const int fine = kFine * size;
    const auto row = std::size_t(fine), slice = row * row;
    std::vector<float> tissue(slice * row);
    for (std::size_t n = 0; n < tissue.size(); ++n) {
        const ContinuousIndex3 at{double(n % row) / kFine, double(n / row % row) / kFine, double(n / slice) / kFine};
        tissue[n] = solid.isTissue(place.toScene(grid.pointAt(at))) ? 1 : 0;
    }
    for (const std::size_t stride : {std::size_t(1), row, slice})
        blurAlong(tissue, fine, stride, scene.blur_mm / kVoxel_mm * kFine);
    HuVolume hu(grid);
    std::normal_distribution<double> noise(0, std::max(scene.noise_hu, 1e-9));
    for (std::size_t n = 0; n < hu.voxels.size(); ++n) {
        const Index3 v = grid.indexOf(n);
        const auto i = std::size_t(kFine * v.i), j = std::size_t(kFine * v.j), k = std::size_t(kFine * v.k);
        const double s = double(tissue[i + row * j + slice * k]);
        hu.voxels[n] =
            std::int16_t(std::lround(kGasHu + s * (kTissueHu - kGasHu) + (scene.noise_hu > 0 ? noise(random) : 0)));
    }
    return hu;
}

}  // namespace

PolypOnWall wallOf(const PolypScene& scene)
{
    constexpr double kAround_mm = 9;
    std::mt19937 random(scene.seed);
    const Solid solid(scene);
    const Place place(random, solid.top_mm() / 2);
    const int size = int((std::max(scene.diameter_mm, solid.top_mm()) + 2 * kAround_mm) / kVoxel_mm);
    const HuVolume hu = scanned(scene, solid, place, size, random);
    InsideVolume inside(hu.grid, kOutside);
    std::transform(hu.voxels.begin(), hu.voxels.end(), inside.voxels.begin(),
                   [](std::int16_t v) { return std::uint8_t(v < (kGasHu + kTissueHu) / 2 ? kGas : kOutside); });
    NoProgress quiet;
    const steps::TissueResult found =
        steps::findTissue(hu, inside, {0, 1, 0}, {}, std::max(10.0, scene.noise_hu), quiet);
    const SegmentVolume one(hu.grid, 1);
    PolypOnWall wall{steps::LumenSurface(found.tissue, found.lumen, quiet).cellsOf(one, quiet), {}};
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

#include "vicon/viewer/model/peeling.h"

#include <gtest/gtest.h>

#include "test_colon.h"
#include "vicon/core/error.h"
#include "vicon/viewer/model/peeling_pace.h"
#include "vicon/viewer/model/view_pose.h"

namespace vicon::viewer {
namespace {

using test::TestColon;

/// Trilinear density in doubles; empty outside the scan and beside padding.
std::optional<double> densityAt(const HuVolume& volume, Point3 p)
{
    const ContinuousIndex3 c = volume.grid.continuousIndexAt(p);
    const Index3 v{int(std::floor(c.i)), int(std::floor(c.j)), int(std::floor(c.k))};
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Index3 w{v.i + (corner & 1), v.j + (corner >> 1 & 1), v.k + (corner >> 2)};
        if (volume.valueOr(w, kPaddingHu) == kPaddingHu)
            return {};
        sum += volume.at(w) * (1 - std::abs(c.i - w.i)) * (1 - std::abs(c.j - w.j)) * (1 - std::abs(c.k - w.k));
    }
    return sum;
}

/// A ray caster with nothing clever in it: every sample from the eye on, no wall, no table, no early end.
std::array<double, 4> castPlainly(const HuVolume& volume, Point3 eye, Vector3 direction,
                                  const TransferFunction& colours, const PeelingOptions& options)
{
    std::array<double, 4> out{};
    double left = 1;
    for (int n = 0; n * options.step_mm < 400; ++n) {
        const double t = n * options.step_mm;
        const auto density = densityAt(volume, eye + direction * t);
        if (!density)
            continue;
        const TransferPoint p = colours.at(*density);
        const double opacity = 1 - std::pow(1 - p.opacity_per_mm, options.step_mm);
        const double lamp = std::sqrt(1.12 / (1 + t * t / (options.lamp_reach_mm * options.lamp_reach_mm)));
        out[0] += left * opacity * lamp * p.red;
        out[1] += left * opacity * lamp * p.green;
        out[2] += left * opacity * lamp * p.blue;
        left *= 1 - opacity;
    }
    out[3] = 1 - left;
    for (double& value : out)
        value = std::min(value, 1.0) * 255;
    return out;
}

Pose poseInside(const TestColon& colon, double share)
{
    const PathFrames path(colon.skeleton);
    return poseAtStation(path, Lumen(colon.inside, colon.wall_distance), share * path.length_mm()).pose;
}

class PeelingInStorage : public testing::TestWithParam<int> {};

TEST_P(PeelingInStorage, EqualsAPlainCasterFromTheEyeWithinOneGreyLevel)
{
    const TestColon colon(test::storages().at(std::size_t(GetParam())));
    const Lumen lumen(colon.inside, colon.wall_distance);
    const Lens lens{90, 40, 40};
    for (const std::string name : {"soft-tissue", "polyp", "fat"})
        for (const double share : {0.1, 0.45, 0.8}) {
            const Pose pose = poseInside(colon, share);
            PeelingOptions options;
            options.shaded = false;
            options.reach_mm = 400;
            const PeeledPicture picture = peel(colon.volume, lumen, pose, lens, transferFunction(name), options);
            for (int y = 0; y < lens.height; ++y)
                for (int x = 0; x < lens.width; ++x) {
                    const Vector3 ray = rayThrough(pose, lens, {x + 0.5, y + 0.5});
                    const auto wanted = castPlainly(colon.volume, pose.eye_mm, ray, transferFunction(name), options);
                    for (std::size_t c = 0; c < 4; ++c)
                        ASSERT_NEAR(picture.rgba[4 * std::size_t(y * lens.width + x) + c], std::round(wanted[c]), 1)
                            << name << " at " << share << ", pixel " << x << ", " << y;
                }
        }
}

TEST(DensityBricks, KnowTheDensitiesFromWhichSamplesInThemAreMade)
{
    HuVolume volume(Grid{.size = {19, 17, 9}});
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(int(n * 7919 % 3001) - 1000);
    volume.at({14, 3, 4}) = kPaddingHu;
    const DensityBricks bricks{HuView(volume)};
    for (int asked = 0; asked < 2; ++asked)  // looked at, then known
        for (const Index3 first : {Index3{0, 0, 0}, Index3{8, 0, 0}, Index3{16, 8, 8}, Index3{8, 16, 0}}) {
            const DensityBricks::Range range = bricks.around(bricks.brickOf(first.i + 1, first.j, first.k));
            std::int16_t lowest = INT16_MAX, highest = INT16_MIN;
            for (int k = first.k - 1; k < first.k + 10; ++k)
                for (int j = first.j - 1; j < first.j + 10; ++j)
                    for (int i = first.i - 1; i < first.i + 10; ++i)
                        if (volume.grid.contains({i, j, k})) {
                            lowest = std::min(lowest, volume.at({i, j, k}));
                            highest = std::max(highest, volume.at({i, j, k}));
                        }
            EXPECT_EQ(range.lowest, lowest);
            EXPECT_EQ(range.highest, highest);
            EXPECT_TRUE(range.padding) << "all of these lie at the border";
        }
    const HuVolume even(Grid{.size = {40, 40, 40}}, 5);
    const DensityBricks inner{HuView(even)};
    EXPECT_FALSE(inner.around(inner.brickOf(20, 20, 20)).padding);
}

TEST(Peeling, WhileMovingShowsNearlyTheSame)
{
    const TestColon colon(test::storages().front());
    const Lumen lumen(colon.inside, colon.wall_distance);
    const Lens lens{90, 40, 40};
    const Pose pose = poseInside(colon, 0.45);
    for (const std::string name : {"soft-tissue", "polyp", "fat"}) {
        const PeelingOptions still;
        const auto slow = peel(colon.volume, lumen, pose, lens, transferFunction(name), still);
        const auto quick = peel(colon.volume, lumen, pose, lens, transferFunction(name), still.whileMoving());
        double sum = 0;
        for (std::size_t n = 0; n < slow.rgba.size(); ++n)
            sum += std::abs(int(slow.rgba[n]) - int(quick.rgba[n]));
        EXPECT_GT(sum, 0) << "they are not the same picture";
        EXPECT_LT(sum / double(slow.rgba.size()), 10) << name;
    }
}

TEST(PeelingPace, KeepsTenPicturesASecondOnAnyMachine)
{
    for (const double ray_s : {1e-7, 1e-6, 4e-6, 2e-5}) {
        PeelingPace pace;
        int coarse = 0;
        double seconds = 0;
        for (int n = 0; n < 12; ++n) {
            coarse = pace.coarseFor(900, 700);
            seconds = std::ceil(900.0 / coarse) * std::ceil(700.0 / coarse) * ray_s;
            pace.tell(900, 700, coarse, seconds);
        }
        if (coarse < PeelingPace::kCoarsest) {
            EXPECT_LT(seconds, 0.1) << ray_s;
        }
        if (coarse > 1) {
            EXPECT_GT(seconds * coarse * coarse / ((coarse - 1) * (coarse - 1)), 0.07)
                << "needlessly coarse, " << ray_s;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Storages, PeelingInStorage, testing::Range(0, int(test::storages().size())));

/// A cube of even density with a hollow of 30 x 30 x 30 mm in its middle; layers of other density at chosen depths.
struct HollowCube {
    HuVolume volume;
    InsideVolume inside;
    FieldVolume wall;

    explicit HollowCube(std::int16_t tissue_hu)
    {
        Grid grid;
        grid.size = {71, 71, 71};
        grid.origin_mm = {-35, -35, -35};
        volume = HuVolume(grid, tissue_hu);
        inside = InsideVolume(grid, kOutside);
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 15.5) {
                volume.voxels[n] = -1000;
                inside.voxels[n] = kGas;
            }
        }
        wall = test::wallDistanceOf(inside);
    }
};

TransferFunction evenOpacity(double per_mm)
{
    return {"even", "Even", {{-300, 1, 1, 1, 0}, {-299, 1, 1, 1, per_mm}}};
}

TEST(Peeling, EvenTissueStopsThePartOfTheLightThatItsThicknessSays)
{
    const HollowCube cube(40);
    const Lumen lumen(cube.inside, cube.wall);
    PeelingOptions options;
    options.begin = PeelingOptions::Begin::eye;
    options.step_mm = 0.1;
    for (const double per_mm : {0.02, 0.1}) {
        const auto picture =
            peel(cube.volume, lumen, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {10, 1, 1}, evenOpacity(per_mm), options);
        // From the wall at 15.5 mm, where the density crosses, to the edge of the scan at 35 mm.
        EXPECT_NEAR(picture.rgba[3], 255 * (1 - std::pow(1 - per_mm, 19.5)), 2.5);
    }
}

TEST(Peeling, AnOffsetTakesAwayWhatLiesBeforeIt)
{
    HollowCube cube(40);
    // A layer of contrast 4 to 8 mm behind the wall.
    for (std::size_t n = 0; n < cube.volume.voxels.size(); ++n) {
        const double x = cube.volume.grid.pointAt(cube.volume.grid.indexOf(n)).x;
        if (x > 19.5 && x < 23.5)
            cube.volume.voxels[n] = 600;
    }
    const Lumen lumen(cube.inside, cube.wall);
    const TransferFunction contrast{"contrast", "Contrast", {{300, 1, 0, 0, 0}, {301, 1, 0, 0, 0.9}}};
    const auto opacityFrom = [&](double offset_mm) {
        PeelingOptions options;
        options.offset_mm = offset_mm;
        return peel(cube.volume, lumen, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {10, 1, 1}, contrast, options).rgba[3];
    };
    EXPECT_GT(opacityFrom(0), 250);
    EXPECT_GT(opacityFrom(4), 250);
    EXPECT_LT(opacityFrom(8.5), 5);
}

/// A tube along z. The density grows with the distance from its axis: what a ray shows tells where it begins.
struct DensityTube {
    static constexpr double kRadius_mm = 12, kVoxel_mm = 0.5, kPerMm_hu = 100;
    HuVolume volume;
    InsideVolume inside;
    FieldVolume wall;

    DensityTube()
    {
        Grid grid;
        grid.size = {101, 101, 121};
        grid.spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm};
        grid.origin_mm = {-25, -25, -30};
        volume = HuVolume(grid);
        inside = InsideVolume(grid, kOutside);
        for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
            const Point3 p = grid.pointAt(grid.indexOf(n));
            const double radius_mm = std::hypot(p.x, p.y);
            volume.voxels[n] = std::int16_t(std::lround(kPerMm_hu * radius_mm) - 1000);
            inside.voxels[n] = radius_mm < kRadius_mm ? kGas : kOutside;
        }
        wall = test::wallDistanceOf(inside);
    }
    /// How far from the axis a ray from its middle begins: its first sample stops all of the light.
    double beginsAtRadius_mm(Vector3 direction, double offset_mm) const
    {
        constexpr double kMost_hu = 1000, kMostRed = 0.9, kExposure = 1.12;
        PeelingOptions options;
        options.offset_mm = offset_mm;
        options.step_mm = 0.1;
        options.shaded = false;
        options.lamp_reach_mm = 1e6;  // as bright everywhere
        const TransferFunction grey{"grey", "Grey", {{-1000, 0, 0, 0, 1}, {kMost_hu, kMostRed, 0, 0, 1}}};
        const Pose pose{{0, 0, 0}, direction, {0, 0, 1}};
        const auto picture = peel(volume, Lumen(inside, wall), pose, {10, 1, 1}, grey, options);
        EXPECT_EQ(picture.rgba[3], 255);
        return picture.rgba[0] / (255 * kMostRed * std::sqrt(kExposure)) * (kMost_hu + 1000) / kPerMm_hu;
    }
};

TEST(Peeling, RaysBeginAtTheWallAndTheOffsetAlongThemAlsoBeforeIt)
{
    constexpr double kGreyAndStep_mm = 0.2;
    const DensityTube tube;
    for (const Vector3 direction : {Vector3{1, 0, 0}, Vector3{0.6, -0.8, 0}, normalized(Vector3{-1, 0.5, 0.6})}) {
        const double outwards = std::hypot(direction.x, direction.y);  // of a millimetre along the ray
        const auto wall_mm = distanceToWall_mm(Lumen(tube.inside, tube.wall), {0, 0, 0}, direction, 100);
        ASSERT_TRUE(wall_mm);
        EXPECT_NEAR(*wall_mm * outwards, DensityTube::kRadius_mm, DensityTube::kVoxel_mm) << "in closed form";
        for (const double offset_mm : {-5.0, -2.0, 0.0, 2.0, 5.0}) {
            const double begins_mm = tube.beginsAtRadius_mm(direction, offset_mm);
            EXPECT_NEAR(begins_mm, (*wall_mm + offset_mm) * outwards, kGreyAndStep_mm) << offset_mm;
            EXPECT_NEAR(begins_mm, DensityTube::kRadius_mm + offset_mm * outwards,
                        DensityTube::kVoxel_mm + kGreyAndStep_mm)
                << offset_mm << ", in closed form";
        }
    }
}

/// What a depth buffer holds: how far along a ray the nearest triangle is met, and how steeply.
struct Met {
    double depth_mm = 1e9, cosine = 0;
};

Met nearestTriangle(const CellSurface& surface, Point3 eye, Vector3 ray)
{
    Met nearest;
    for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
        const std::uint32_t* corner = &surface.triangles[3 * t];
        const Point3 a = surface.point(corner[0]);
        const Vector3 ab = surface.point(corner[1]) - a, ac = surface.point(corner[2]) - a, to_eye = eye - a;
        const Vector3 across = cross(ray, ac), turned = cross(to_eye, ab);
        const double volume = dot(ab, across), depth_mm = dot(ac, turned) / volume;
        const double u = dot(to_eye, across) / volume, v = dot(ray, turned) / volume;
        if (u >= 0 && v >= 0 && u + v <= 1 && depth_mm > 0 && depth_mm < nearest.depth_mm)
            nearest = {depth_mm, std::abs(dot(ray, normalized(cross(ab, ac))))};
    }
    return nearest;
}

TEST(Peeling, RaysBeginAtTheDepthOfTheSurfaceThatIsDrawn)
{
    const TestColon colon;
    const Lumen lumen(colon.inside, colon.wall_distance);
    const Lens lens{90, 12, 12};
    std::vector<double> off_mm;  // across the wall: a ray that grazes it is off by more along itself
    for (const double share : {0.1, 0.45, 0.8}) {
        const Pose pose = poseInside(colon, share);
        for (int n = 0; n < lens.width * lens.height; ++n) {
            const Vector3 ray = rayThrough(pose, lens, {n % lens.width + 0.5, n / lens.width + 0.5});
            const auto wall_mm = distanceToWall_mm(lumen, pose.eye_mm, ray, 500);
            ASSERT_TRUE(wall_mm);
            const Met met = nearestTriangle(colon.cells, pose.eye_mm, ray);
            off_mm.push_back(std::abs(*wall_mm - met.depth_mm) * met.cosine);
        }
    }
    std::sort(off_mm.begin(), off_mm.end());
    EXPECT_LT(off_mm[off_mm.size() / 2], 0.75 * lumen.voxel_mm());
    EXPECT_LT(off_mm[off_mm.size() * 9 / 10], 1.5 * lumen.voxel_mm()) << "some pass the edge of a fold";
}

TEST(Peeling, RaysThatWouldBeginBehindTheEyeBeginThereAndReachAsDeepAsOthers)
{
    const DensityTube tube;
    for (const double offset_mm : {-DensityTube::kRadius_mm, -20.0, -1000.0})
        EXPECT_NEAR(tube.beginsAtRadius_mm({1, 0, 0}, offset_mm), 0, 0.5) << offset_mm;
    // Nothing before the wall has opacity: it is no matter where a ray begins.
    const HollowCube cube(40);
    PeelingOptions options;
    options.reach_mm = 10;
    const auto opacityFrom = [&](double offset_mm) {
        options.offset_mm = offset_mm;
        const Lumen lumen(cube.inside, cube.wall);
        return peel(cube.volume, lumen, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {10, 1, 1}, evenOpacity(0.1), options)
            .rgba[3];
    };
    for (const double offset_mm : {-2.0, -10.0, -20.0, -1000.0})
        EXPECT_EQ(opacityFrom(offset_mm), opacityFrom(0)) << offset_mm;
    EXPECT_GT(opacityFrom(0), 100);
}

TEST(Peeling, TaggedFluidIsLookedThroughFromTheWallAndSeenFromTheEye)
{
    HollowCube cube(40);
    for (std::size_t n = 0; n < cube.inside.voxels.size(); ++n)
        if (cube.inside.voxels[n] != kOutside && cube.inside.grid.pointAt(cube.inside.grid.indexOf(n)).x > 5) {
            cube.inside.voxels[n] = kFluid;
            cube.volume.voxels[n] = 500;
        }
    const Lumen lumen(cube.inside, cube.wall);
    const TransferFunction tagging{"tagging", "Tagging", {{300, 0, 1, 0, 0}, {301, 0, 1, 0, 0.9}}};
    PeelingOptions options;
    const Pose pose{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    EXPECT_LT(peel(cube.volume, lumen, pose, {10, 1, 1}, tagging, options).rgba[3], 255 * 0.8);
    options.begin = PeelingOptions::Begin::eye;
    EXPECT_GT(peel(cube.volume, lumen, pose, {10, 1, 1}, tagging, options).rgba[3], 250);
}

TEST(Peeling, OnlyTheCircleIsPeeled)
{
    const HollowCube cube(40);
    const Lumen lumen(cube.inside, cube.wall);
    const Lens lens{90, 32, 24};
    const PictureCircle circle{{10, 12}, 6};
    const auto picture =
        peel(cube.volume, lumen, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, lens, transferFunction("soft-tissue"), {}, circle);
    for (int y = 0; y < lens.height; ++y)
        for (int x = 0; x < lens.width; ++x)
            EXPECT_EQ(picture.rgba[4 * std::size_t(y * lens.width + x) + 3] > 0, circle.holds({x + 0.5, y + 0.5}));
}

TEST(Peeling, TheWallIsMetWhereTheDistanceSaysAndNowhereWithoutOne)
{
    const HollowCube cube(40);
    const Lumen lumen(cube.inside, cube.wall);
    for (const Vector3 d : {Vector3{1, 0, 0}, Vector3{0, -1, 0}, normalized(Vector3{1, 0.4, -0.2})}) {
        const double exact = 15.5 / std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        const auto found = distanceToWall_mm(lumen, {0, 0, 0}, d, 100);
        ASSERT_TRUE(found.has_value());
        EXPECT_NEAR(*found, exact, 0.8);
    }
    EXPECT_FALSE(distanceToWall_mm(lumen, {0, 0, 0}, {1, 0, 0}, 10).has_value());
}

TEST(Peeling, APictureOrAStepOutOfRangeIsRefused)
{
    const HollowCube cube(40);
    const Lumen lumen(cube.inside, cube.wall);
    PeelingOptions options;
    options.step_mm = 0;
    EXPECT_THROW(peel(cube.volume, lumen, {}, {90, 8, 8}, evenOpacity(0.5), options), Error);
    EXPECT_THROW(peel(cube.volume, lumen, {}, {90, 0, 8}, evenOpacity(0.5)), Error);
}

TEST(Peeling, IsGivenUpWhenNobodyWantsIt)
{
    class Unwanted : public NoProgress {
        bool cancelled() const override { return true; }
    } unwanted;
    const HollowCube cube(40);
    const Lumen lumen(cube.inside, cube.wall);
    try {
        peel(DensityBricks(cube.volume), lumen, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {90, 64, 64}, evenOpacity(0.5), {},
             {}, &unwanted);
        FAIL() << "it went on";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::cancelled);
    }
}

TEST(Peeling, IsLaidOverByItsOpacity)
{
    std::vector<std::uint8_t> rgb{100, 100, 100, 100, 100, 100};
    blendOver(rgb, {2, 1, {0, 0, 0, 0, 200, 100, 0, 255}});
    EXPECT_EQ(rgb, (std::vector<std::uint8_t>{100, 100, 100, 200, 100, 0}));
}

}  // namespace
}  // namespace vicon::viewer

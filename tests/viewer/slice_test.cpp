#include <gtest/gtest.h>

#include "test_colon.h"
#include "vicon/viewer/model/slice_image.h"

namespace vicon::viewer {
namespace {

// A density that is linear in patient coordinates is reproduced exactly by trilinear sampling on whatever grid.
double densityAt(Point3 p)
{
    return 3 * p.x - 5 * p.y + 7 * p.z;
}

HuVolume linearVolume(const test::Storage& storage)
{
    Grid grid;
    grid.size = {40, 36, 44};
    grid.spacing_mm = {2, 2, 2};
    grid.axis = storage.axis;
    const auto half = grid.axis[0] * 39. + grid.axis[1] * 35. + grid.axis[2] * 43.;
    grid.origin_mm = Point3{} - half;
    HuVolume volume(grid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(std::lround(densityAt(grid.pointAt(grid.indexOf(n)))));
    return volume;
}

TEST(Slices, ShowTheDensityOfEachPixelsPointHoweverTheScanIsStored)
{
    const Point3 point{7, -4, 11};
    for (const test::Storage& storage : test::storages()) {
        const HuVolume volume = linearVolume(storage);
        for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::coronal, SlicePlane::sagittal}) {
            const PlaneView view = sliceThrough(volume.grid, plane, point, 60, 50, 40);
            const auto densities = sliceDensities(volume, view);
            for (int y = 0; y < view.height; y += 7)
                for (int x = 0; x < view.width; x += 7) {
                    const Point3 p = view.pointAt({x + 0.5, y + 0.5});
                    EXPECT_NEAR(densities[std::size_t(y * view.width + x)], densityAt(p), 1)
                        << storage.name << ", " << nameOf(plane);
                }
        }
    }
}

TEST(Slices, ShowEachVoxelAsItIsPixelForPixel)
{
    Grid grid;
    grid.size = {40, 36, 20};
    grid.spacing_mm = {0.7, 0.7, 1.25};
    grid.origin_mm = {-11, 4, 3};
    HuVolume volume(grid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(n * 7919 % 2000);  // no two neighbours are alike
    const Point3 point = grid.pointAt(ContinuousIndex3{17.3, 20.2, 9.4});
    for (const int width : {16, 17}) {
        const PlaneView whole = sliceThrough(grid, SlicePlane::axial, point, width, 12);
        const PlaneView view = pixelForPixel(grid, whole, point);
        EXPECT_EQ(view.mm_per_pixel, 0.7);
        const auto densities = sliceDensities(volume, view);
        const Index3 middle = grid.indexAt(point);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const Index3 voxel{middle.i + x - width / 2, middle.j + y - 6, middle.k};
                EXPECT_NEAR(densities[std::size_t(y * width + x)], volume.voxels[grid.offset(voxel)], 1e-3);
            }
    }
}

TEST(Slices, ShowTheMeanOfFourVoxelsAtHalfResolution)
{
    Grid grid;
    grid.size = {40, 36, 20};
    grid.spacing_mm = {0.7, 0.7, 1.25};
    HuVolume volume(grid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(n * 7919 % 2000);
    const Index3 middle{18, 17, 9};
    const Point3 point = grid.pointAt(middle);
    const PlaneView view = pixelForPixel(grid, sliceThrough(grid, SlicePlane::axial, point, 10, 8), point, 2);
    EXPECT_EQ(view.mm_per_pixel, 1.4);
    const auto densities = sliceDensities(volume, view);
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            double sum = 0;
            for (int n = 0; n < 4; ++n)
                sum += volume.at({middle.i + 2 * (x - 5) + n % 2, middle.j + 2 * (y - 4) + n / 2, middle.k});
            EXPECT_NEAR(densities[std::size_t(y * view.width + x)], sum / 4, 1e-2);
        }
}

TEST(Slices, PassThroughTheirPointAndShowTheWholeScan)
{
    const Point3 point{7, -4, 11};
    for (const test::Storage& storage : test::storages()) {
        const HuVolume volume = linearVolume(storage);
        const Bounds bounds = boundsOf(volume.grid);
        for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::coronal, SlicePlane::sagittal}) {
            const PlaneView view = sliceThrough(volume.grid, plane, point, 64, 48);
            EXPECT_NEAR(view.depth_mm(point), 0, 1e-9);
            for (const Point3 corner : {bounds.lower_mm, bounds.upper_mm}) {
                const Pixel at = view.toPixel(corner);
                EXPECT_GE(at.x, -1e-6) << storage.name;
                EXPECT_LE(at.x, 64 + 1e-6) << storage.name;
                EXPECT_GE(at.y, -1e-6) << storage.name;
                EXPECT_LE(at.y, 48 + 1e-6) << storage.name;
            }
        }
    }
}

TEST(Slices, AreBlankOutsideTheScan)
{
    const HuVolume volume = linearVolume(test::storages().front());
    const PlaneView view = sliceThrough(volume.grid, SlicePlane::axial, {300, 0, 0}, 20, 20, 40);
    for (const float density : sliceDensities(volume, view))
        EXPECT_EQ(density, kPaddingHu);
}

}  // namespace
}  // namespace vicon::viewer

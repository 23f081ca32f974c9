#include "vicon/viewer/model/thick_slice.h"

#include <gtest/gtest.h>

#include <random>

#include "test_colon.h"
#include "vicon/viewer/model/slice_image.h"

namespace vicon::viewer {
namespace {

constexpr double kVoxel_mm = 1;

/// Planes along z of one density each, `0, 10, 20, ...`, and one dark voxel.
HuVolume steps(const test::Storage& storage)
{
    Grid grid;
    grid.size = {30, 30, 30};
    grid.spacing_mm = {kVoxel_mm, kVoxel_mm, kVoxel_mm};
    grid.axis = storage.axis;
    grid.origin_mm = Point3{} - (grid.axis[0] + grid.axis[1] + grid.axis[2]) * 14.5;
    HuVolume volume(grid);
    for (std::size_t n = 0; n < volume.voxels.size(); ++n)
        volume.voxels[n] = std::int16_t(std::lround(10 * grid.pointAt(grid.indexOf(n)).z));
    return volume;
}

TEST(ThickSlice, MeanAndMinimumAreThoseOfTheDensitiesAcrossIt)
{
    for (const test::Storage& storage : test::storages()) {
        const HuVolume volume = steps(storage);
        const PlaneView view = sliceThrough(volume.grid, SlicePlane::axial, {0, 0, 2}, 11, 11, 6);
        for (const double thickness : {3.0, 5.0, 8.0}) {
            const auto mean = thickSliceDensities(volume, nullptr, view, {ThickSlice::Kind::mean, thickness});
            const auto least = thickSliceDensities(volume, nullptr, view, {ThickSlice::Kind::minimum, thickness});
            for (std::size_t n = 0; n < mean.size(); ++n) {
                ASSERT_NEAR(mean[n], 20, 1) << storage.name << " of a ramp: its middle";
                ASSERT_NEAR(least[n], 20 - 5 * thickness, 1) << storage.name;
            }
        }
    }
}

TEST(ThickSlice, OfOnePlaneIsThePlane)
{
    const HuVolume volume = steps(test::storages().front());
    const PlaneView view = sliceThrough(volume.grid, SlicePlane::coronal, {1, 2, 3}, 21, 17, 20);
    EXPECT_EQ(thickSliceDensities(volume, nullptr, view, {}), sliceDensities(volume, view));
    EXPECT_EQ(nameOf(ThickSlice{}), "");
    EXPECT_EQ(nameOf(ThickSlice{ThickSlice::Kind::minimum, 10}), "minimum of 10 mm");
}

TEST(ThickSlice, WhatLiesOutsideTheScanDoesNotCount)
{
    const HuVolume volume = steps(test::storages().front());
    const PlaneView last = sliceThrough(volume.grid, SlicePlane::axial, {0, 0, 14.5}, 5, 5, 4);
    for (const float density : thickSliceDensities(volume, nullptr, last, {ThickSlice::Kind::minimum, 6}))
        EXPECT_NEAR(density, 115, 1) << "3 mm below the last plane, and not the padding above it";
    const PlaneView away = sliceThrough(volume.grid, SlicePlane::axial, {0, 0, 60}, 5, 5, 4);
    for (const float density : thickSliceDensities(volume, nullptr, away, {ThickSlice::Kind::mean, 6}))
        EXPECT_EQ(density, kPaddingHu);
}

TEST(ThickSlice, ShowsADarkBubbleThatLiesBesideThePlane)
{
    HuVolume volume = steps(test::storages().front());
    std::fill(volume.voxels.begin(), volume.voxels.end(), std::int16_t(40));
    volume.voxels[volume.grid.offset(volume.grid.indexAt({0.5, 0.5, 2.5}))] = -900;
    const PlaneView view = sliceThrough(volume.grid, SlicePlane::axial, {0.5, 0.5, 0.5}, 1, 1, 1);
    EXPECT_NEAR(thickSliceDensities(volume, nullptr, view, {})[0], 40, 1);
    EXPECT_NEAR(thickSliceDensities(volume, nullptr, view, {ThickSlice::Kind::minimum, 4})[0], -900, 1);
    EXPECT_NEAR(thickSliceDensities(volume, nullptr, view, {ThickSlice::Kind::minimum, 2})[0], 40, 1);
}

TEST(ThickSlice, TakesWhatWasCleansedWhereThatIsShown)
{
    const HuVolume volume = steps(test::storages().front());
    HuVolume clean = volume;
    std::fill(clean.voxels.begin(), clean.voxels.end(), std::int16_t(-1000));
    const PlaneView view = sliceThrough(volume.grid, SlicePlane::axial, {0, 0, 2}, 3, 3, 2);
    const HuView cleansed = clean;
    for (const float density : thickSliceDensities(volume, &cleansed, view, {ThickSlice::Kind::mean, 5}))
        EXPECT_NEAR(density, -1000, 1);
}

}  // namespace
}  // namespace vicon::viewer

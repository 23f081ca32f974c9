#include "vicon/steps/resample.h"

#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkImportImageFilter.h>
#include <itkResampleImageFilter.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "vicon/core/error.h"

namespace vicon::steps {
namespace {

NoProgress quiet;

std::array<Vector3, 3> rotated(double degrees)
{
    // about the unit vector (1,2,3)/sqrt(14), by Rodrigues' formula
    const Vector3 about = Vector3{1, 2, 3} / std::sqrt(14.0);
    const double a = degrees * M_PI / 180;
    const auto turn = [&](Vector3 v) {
        return v * std::cos(a) + cross(about, v) * std::sin(a) + about * (dot(about, v) * (1 - std::cos(a)));
    };
    return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})};
}

HuVolume randomVolume(Grid grid, int seed = 1)
{
    HuVolume volume(grid);
    std::mt19937 random(static_cast<unsigned>(seed));
    for (auto& voxel : volume.voxels)
        voxel = std::int16_t(int(random() % 3000) - 1000);
    return volume;
}

/// The same measurement stored otherwise: new axis d is old axis order[d], reversed where flip[d].
HuVolume restored(const HuVolume& volume, std::array<std::size_t, 3> order, std::array<bool, 3> flip)
{
    const Grid& from = volume.grid;
    Grid to = from;
    for (std::size_t d = 0; d < 3; ++d) {
        const std::size_t a = order[d];
        to.size[d] = from.size[a];
        to.spacing_mm[d] = from.spacing_mm[a];
        to.axis[d] = flip[d] ? -from.axis[a] : from.axis[a];
        if (flip[d])
            to.origin_mm += from.axis[a] * (from.spacing_mm[a] * (from.size[a] - 1));
    }
    HuVolume out(to);
    for (std::size_t n = 0; n < to.voxelCount(); ++n) {
        const Index3 v = to.indexOf(n);
        const std::array<int, 3> at{v.i, v.j, v.k};
        std::array<int, 3> source{};
        for (std::size_t d = 0; d < 3; ++d)
            source[order[d]] = flip[d] ? to.size[d] - 1 - at[d] : at[d];
        out.voxels[n] = volume.at({source[0], source[1], source[2]});
    }
    return out;
}

TEST(Resample, IsBitForBitTheSameWhateverTheStorageOrderAndMirroring)
{
    for (const double degrees : {0.0, 17.0}) {
        const Grid grid{.size = {13, 11, 9},
                        .origin_mm = {-71.37, 12.5, 803.125},
                        .spacing_mm = {0.7, 0.7, 1.25},
                        .axis = rotated(degrees)};
        HuVolume measured = randomVolume(grid);
        measured.at({3, 4, 5}) = kPaddingHu;
        const HuVolume expected = resample(measured, {}, quiet);
        std::array<std::size_t, 3> order{0, 1, 2};
        do
            for (int flips = 0; flips < 8; ++flips) {
                const HuVolume stored = restored(measured, order, {bool(flips & 1), bool(flips & 2), bool(flips & 4)});
                const HuVolume got = resample(stored, {}, quiet);
                ASSERT_EQ(got.voxels, expected.voxels) << flips;
                ASSERT_EQ(got.grid, expected.grid) << flips;
            }
        while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST(Resample, KeepsEveryDensityAtItsPlaceInThePatient)
{
    // A ramp in patient coordinates, stored feet first and from left to right: any swap would show.
    const auto ramp = [](Point3 p) { return 3 * p.x - 5 * p.y + 2 * p.z; };
    Grid grid{.size = {20, 18, 16}, .origin_mm = {15, -12, 40}, .spacing_mm = {0.8, 0.8, 1.5}};
    grid.axis = {Vector3{-1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, -1}};
    HuVolume acquired(grid);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n)
        acquired.voxels[n] = std::int16_t(std::lround(ramp(grid.pointAt(grid.indexOf(n)))));
    const HuVolume out = resample(acquired, {}, quiet);
    EXPECT_EQ(out.grid.size, (std::array<int, 3>{20, 18, 29}));
    EXPECT_EQ(out.grid.axis, (std::array<Vector3, 3>{Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}));
    for (const double spacing_mm : out.grid.spacing_mm)
        EXPECT_EQ(spacing_mm, 0.8);
    for (std::size_t n = 0; n < out.grid.voxelCount(); ++n)
        ASSERT_NEAR(out.voxels[n], ramp(out.grid.pointAt(out.grid.indexOf(n))), 1.01);
}

TEST(Resample, AgreesWithItk)
{
    using Image = itk::Image<std::int16_t, 3>;
    for (const double spacing_mm : {0.0, 0.5, 1.1}) {
        const Grid grid{.size = {21, 17, 14}, .spacing_mm = {0.9, 0.7, 1.6}, .axis = rotated(11)};
        const HuVolume acquired = randomVolume(grid, 3);
        const HuVolume out = resample(acquired, {spacing_mm}, quiet);

        auto image = Image::New();
        image->SetRegions(Image::SizeType{21, 17, 14});
        image->SetSpacing(grid.spacing_mm.data());
        Image::DirectionType direction;
        for (unsigned d = 0; d < 3; ++d) {
            direction[0][d] = grid.axis[d].x;
            direction[1][d] = grid.axis[d].y;
            direction[2][d] = grid.axis[d].z;
        }
        image->SetDirection(direction);
        image->Allocate();
        std::copy(acquired.voxels.begin(), acquired.voxels.end(), image->GetBufferPointer());
        using Out = itk::Image<float, 3>;
        auto filter = itk::ResampleImageFilter<Image, Out>::New();
        filter->SetInput(image);
        filter->SetSize({std::size_t(out.grid.size[0]), std::size_t(out.grid.size[1]), std::size_t(out.grid.size[2])});
        filter->SetOutputSpacing(out.grid.spacing_mm.data());
        filter->SetOutputDirection(direction);
        filter->SetOutputOrigin(image->GetOrigin());
        filter->Update();
        for (std::size_t n = 0; n < out.grid.voxelCount(); ++n)
            ASSERT_NEAR(out.voxels[n], filter->GetOutput()->GetBufferPointer()[n], 0.51);
    }
}

TEST(Resample, KeepsPaddingOutOfTheInterpolation)
{
    HuVolume acquired(Grid{.size = {4, 4, 3}, .spacing_mm = {1, 1, 2}}, 100);
    acquired.at({1, 1, 1}) = kPaddingHu;
    const HuVolume out = resample(acquired, {}, quiet);
    ASSERT_EQ(out.grid.size[2], 5);
    for (std::size_t n = 0; n < out.grid.voxelCount(); ++n)
        EXPECT_TRUE(out.voxels[n] == 100 || out.voxels[n] == kPaddingHu) << out.voxels[n];
    EXPECT_EQ(out.at({1, 1, 2}), kPaddingHu);
    EXPECT_EQ(out.at({2, 1, 2}), 100);
}

TEST(Resample, DoesNotDependOnTheNumberOfThreads)
{
    const HuVolume acquired = randomVolume(Grid{.size = {40, 30, 50}, .spacing_mm = {0.7, 0.7, 1}});
    const HuVolume both = resample(acquired, {}, quiet);
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(resample(acquired, {}, quiet).voxels, both.voxels);
}

ErrorCode codeOf(const HuVolume& acquired, ResampleOptions options)
{
    try {
        resample(acquired, options, quiet);
    } catch (const Error& e) {
        return e.code();
    }
    return ErrorCode::internal;
}

TEST(Resample, RefusesWhatCannotBeHad)
{
    const HuVolume small(Grid{.size = {60, 60, 60}});
    EXPECT_EQ(codeOf(small, {0.001}), ErrorCode::no_memory);
    EXPECT_EQ(codeOf(small, {1e-9}), ErrorCode::no_memory);
    EXPECT_EQ(codeOf(HuVolume{}, {}), ErrorCode::bad_input);
    EXPECT_EQ(codeOf(HuVolume(Grid{.size = {2, 2, 2}, .spacing_mm = {1, 1, 0}}), {}), ErrorCode::bad_input);
}

}  // namespace
}  // namespace vicon::steps

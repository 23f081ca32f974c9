#include "vicon/steps/resample.h"

#include <gtest/gtest.h>
#include <itkBSplineInterpolateImageFunction.h>
#include <itkImage.h>
#include <itkImportImageFilter.h>
#include <itkMultiThreaderBase.h>
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

class ResampleByEach : public testing::TestWithParam<Interpolation> {
protected:
    ResampleOptions by(double spacing_mm = 0) const { return {.spacing_mm = spacing_mm, .interpolation = GetParam()}; }
};
INSTANTIATE_TEST_SUITE_P(Interpolation, ResampleByEach,
                         testing::Values(Interpolation::linear, Interpolation::bspline, Interpolation::windowed_sinc),
                         [](const auto& about) { return nameIn(kInterpolationNames, about.param); });

TEST_P(ResampleByEach, IsBitForBitTheSameWhateverTheStorageOrderAndMirroring)
{
    // Oblique and straight axes.
    for (const int columns : {13, 16}) {
        const Grid grid{.size = {columns, 11, 9},
                        .origin_mm = {-71.37, 12.5, 803.125},
                        .spacing_mm = {0.7, 0.7, 1.25},
                        .axis = rotated(columns == 13 ? 17 : 0)};
        HuVolume measured = randomVolume(grid);
        measured.at({3, 4, 5}) = kPaddingHu;
        const HuVolume expected = resample(measured, by(), quiet);
        std::array<std::size_t, 3> order{0, 1, 2};
        do
            for (int flips = 0; flips < 8; ++flips) {
                const HuVolume stored = restored(measured, order, {bool(flips & 1), bool(flips & 2), bool(flips & 4)});
                const HuVolume got = resample(stored, by(), quiet);
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
        const HuVolume out = resample(acquired, {.spacing_mm = spacing_mm}, quiet);

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

TEST_P(ResampleByEach, KeepsPaddingOutOfTheInterpolation)
{
    HuVolume acquired(Grid{.size = {24, 20, 18}, .spacing_mm = {1, 1, 2}}, 100);
    for (const Index3 v : {Index3{11, 11, 11}, {12, 11, 11}, {0, 0, 3}})
        acquired.at(v) = kPaddingHu;
    const HuVolume out = resample(acquired, by(), quiet);
    ASSERT_EQ(out.grid.size[2], 35);
    for (std::size_t n = 0; n < out.grid.voxelCount(); ++n)
        EXPECT_TRUE(out.voxels[n] == 100 || out.voxels[n] == kPaddingHu) << out.voxels[n];
    EXPECT_EQ(out.at({11, 11, 22}), kPaddingHu);
    EXPECT_EQ(out.at({13, 11, 22}), 100);
    EXPECT_EQ(out.at({11, 11, 21}), kPaddingHu) << "half-way: the voxel above is the nearest";
    EXPECT_EQ(out.at({11, 11, 23}), 100);
}

TEST_P(ResampleByEach, NeverMakesPaddingOfAnOvershoot)
{
    // Gas beside bone: a smooth curve through both goes below the gas.
    HuVolume acquired(Grid{.size = {16, 16, 40}, .spacing_mm = {1, 1, 1.3}}, -1000);
    for (std::size_t n = 0; n < acquired.voxels.size(); ++n)
        if (const Index3 v = acquired.grid.indexOf(n); v.k > 15 + v.i)
            acquired.voxels[n] = std::int16_t(v.j * 60 - 700);
    const HuVolume out = resample(acquired, by(), quiet);
    EXPECT_EQ(std::count(out.voxels.begin(), out.voxels.end(), kPaddingHu), 0);
}

TEST_P(ResampleByEach, DoesNotDependOnTheNumberOfThreads)
{
    const HuVolume acquired = randomVolume(Grid{.size = {40, 30, 50}, .spacing_mm = {0.7, 0.7, 1}});
    const HuVolume both = resample(acquired, by(), quiet);
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto threads = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
    EXPECT_EQ(resample(acquired, by(), quiet).voxels, both.voxels);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
}

TEST_P(ResampleByEach, KeepsAConstantDensity)
{
    const HuVolume acquired(Grid{.size = {19, 18, 30}, .spacing_mm = {0.9, 0.7, 1.6}}, 700);
    for (const double spacing_mm : {0.0, 0.6, 1.1}) {
        const HuVolume out = resample(acquired, by(spacing_mm), quiet);
        EXPECT_EQ(std::count(out.voxels.begin(), out.voxels.end(), 700), std::ptrdiff_t(out.voxels.size()));
    }
}

/// Densities of a function of the place in voxels.
template <class Function>
HuVolume sampled(const Grid& grid, Function function)
{
    HuVolume volume(grid);
    for (std::size_t n = 0; n < grid.voxelCount(); ++n) {
        const Index3 v = grid.indexOf(n);
        volume.voxels[n] = std::int16_t(std::lround(function(v.i, v.j, v.k)));
    }
    return volume;
}

/// The largest error of a resampled function, in HU, at least `margin` acquired voxels away from the border.
template <class Function>
double largestError(const Grid& grid, const ResampleOptions& options, double margin, Function function)
{
    const HuVolume out = resample(sampled(grid, function), options, quiet);
    double most = 0;
    for (std::size_t n = 0; n < out.grid.voxelCount(); ++n) {
        const ContinuousIndex3 at = grid.continuousIndexAt(out.grid.pointAt(out.grid.indexOf(n)));
        const std::array<double, 3> place{at.i, at.j, at.k};
        bool within = true;
        for (std::size_t d = 0; d < 3; ++d)
            within = within && place[d] >= margin && place[d] <= grid.size[d] - 1 - margin;
        if (within)
            most = std::max(most, std::abs(out.voxels[n] - function(at.i, at.j, at.k)));
    }
    return most;
}

const Grid kBlock{.size = {32, 27, 26}, .spacing_mm = {0.8, 0.8, 1.2}};

TEST(ResampleLinearly, GivesATrilinearFunctionBack)
{
    // Its slopes are whole numbers, so the acquired voxels hold it without rounding.
    const auto trilinear = [](double i, double j, double k) { return 2 * i - 3 * j + k + i * j - j * k; };
    for (const double spacing_mm : {0.0, 0.5, 1.1})
        EXPECT_LE(largestError(kBlock, {.spacing_mm = spacing_mm}, 0, trilinear), 0.501);
}

TEST(ResampleByBSpline, GivesACubicBackAwayFromTheBorder)
{
    const auto cubic = [](double i, double j, double k) {
        const double x = i - 16, y = j - 13, z = k - 13;
        return 10000 + x * x * x - z * z * z + x * y * z - 3 * y * y;  // nowhere the density of padding
    };
    EXPECT_LE(largestError(kBlock, {.interpolation = Interpolation::bspline}, 9, cubic), 0.6);
    EXPECT_LE(largestError(kBlock, {.spacing_mm = 0.5, .interpolation = Interpolation::bspline}, 9, cubic), 0.6);
    EXPECT_GT(largestError(kBlock, {}, 9, cubic), 2);
}

TEST(ResampleByWindowedSinc, GivesAWaveOfFourVoxelsBackToAHundredth)
{
    const auto wave = [](double i, double j, double k) {
        return 1000 * std::cos(M_PI * k / 2 + 0.3) * std::cos(M_PI * i / 8) * std::cos(M_PI * j / 8);
    };
    const double by_sinc = largestError(kBlock, {.interpolation = Interpolation::windowed_sinc}, 3, wave);
    const double linearly = largestError(kBlock, {}, 3, wave);
    EXPECT_LT(by_sinc, 30);
    EXPECT_GT(linearly, 200);
}

TEST(ResampleByBSpline, IsTheSameInSlabsAsInOnePiece)
{
    const Grid grid{.size = {12, 10, 90}, .spacing_mm = {0.7, 0.7, 1}};
    const HuVolume acquired = randomVolume(grid, 5);
    const HuVolume out = resample(acquired, {.interpolation = Interpolation::bspline}, quiet);
    using Image = itk::Image<std::int16_t, 3>;
    auto image = Image::New();
    image->SetRegions(Image::SizeType{12, 10, 90});
    image->Allocate();
    std::copy(acquired.voxels.begin(), acquired.voxels.end(), image->GetBufferPointer());
    auto whole = itk::BSplineInterpolateImageFunction<Image>::New();
    whole->SetInputImage(image);
    for (std::size_t n = 0; n < out.grid.voxelCount(); ++n) {
        const Index3 v = out.grid.indexOf(n);
        const double at[3] = {double(v.i), double(v.j), v.k * 0.7};
        ASSERT_NEAR(out.voxels[n], whole->EvaluateAtContinuousIndex(at), 0.55);
    }
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
    EXPECT_EQ(codeOf(small, {.spacing_mm = 0.001}), ErrorCode::no_memory);
    EXPECT_EQ(codeOf(small, {.spacing_mm = 1e-9}), ErrorCode::no_memory);
    EXPECT_EQ(codeOf(HuVolume{}, {}), ErrorCode::bad_input);
    EXPECT_EQ(codeOf(HuVolume(Grid{.size = {2, 2, 2}, .spacing_mm = {1, 1, 0}}), {}), ErrorCode::bad_input);
}

}  // namespace
}  // namespace vicon::steps

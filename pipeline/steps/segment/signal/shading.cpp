#include <itkN4BiasFieldCorrectionImageFilter.h>
#include <itkOtsuMultipleThresholdsImageFilter.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/blocks.h"
#include "grid/itk_view.h"
#include "segment/signal/classes.h"
#include "vicon/steps/lumen_contrast.h"

namespace vicon::steps {
namespace {

// Chosen on the phantoms of seed 611, dark and bright, with a shading of 1.9 from the darkest to the brightest place:
// blocks of 4 mm and 50 rounds a level take five times as long and give the same lumen (Dice to .001).
constexpr double kBlock_mm = 8;
constexpr unsigned kLevels = 3, kRounds = 20, kControlPoints = 5;
constexpr double kLeastShading = 0.1, kMostShading = 10;  // beyond, the body ends and the splines run away

using N4 = itk::N4BiasFieldCorrectionImageFilter<ItkFloat, ItkMask, ItkFloat>;

/// Stops ITK's rounds when nobody wants them any more.
void checkWhileAtWork(N4& filter, Progress& progress)
{
    filter.AddObserver(itk::IterationEvent(), [&filter, &progress](const itk::EventObject&) {
        if (progress.cancelled())
            filter.SetMaximumNumberOfIterations(N4::VariableSizeArrayType(kLevels, 0U));
    });
}

}  // namespace

std::vector<double> classLimits(const HuVolume& signal, unsigned count)
{
    std::vector<std::int16_t> values(signal.voxels.size());
    std::transform(signal.voxels.begin(), signal.voxels.end(), values.begin(),
                   [](std::int16_t v) { return v == kPaddingHu ? std::int16_t(0) : v; });
    auto otsu = itk::OtsuMultipleThresholdsImageFilter<ItkHu, ItkMask>::New();
    otsu->SetInput(itkView(values.data(), signal.grid.size));
    otsu->SetNumberOfThresholds(count);
    otsu->SetNumberOfHistogramBins(256);
    otsu->Update();
    const auto& limits = otsu->GetThresholds();
    return {limits.begin(), limits.end()};
}

FieldVolume shadingOf(const HuVolume& signal, Progress& progress)
{
    const HuVolume coarse = meanOfBlocks(signal, std::max(1, int(std::lround(kBlock_mm / signal.grid.spacing_mm[0]))));
    const double body_above = classLimits(coarse, 1).front();
    FieldVolume values(coarse.grid, 1), shading(coarse.grid, 1);
    InsideVolume body(coarse.grid);
    for (std::size_t n = 0; n < coarse.voxels.size(); ++n) {
        values.voxels[n] = std::max(1.0F, float(coarse.voxels[n]));
        body.voxels[n] = coarse.voxels[n] > body_above ? 1 : 0;
    }
    if (std::count(body.voxels.begin(), body.voxels.end(), std::uint8_t(1)) == 0)
        return shading;
    auto filter = N4::New();
    filter->SetInput(itkView(values.voxels.data(), coarse.grid.size));
    filter->SetMaskImage(itkView(body.voxels.data(), coarse.grid.size));
    filter->SetNumberOfFittingLevels(kLevels);
    filter->SetMaximumNumberOfIterations(N4::VariableSizeArrayType(kLevels, kRounds));
    filter->SetNumberOfControlPoints(kControlPoints);
    checkWhileAtWork(*filter, progress);
    filter->Update();
    progress.check();
    const auto log_shading = filter->ReconstructBiasField(filter->GetLogBiasFieldControlPointLattice());
    double sum = 0, count = 0;
    for (std::size_t n = 0; n < shading.voxels.size(); ++n) {
        shading.voxels[n] = std::exp(log_shading->GetBufferPointer()[n]);
        sum += body.voxels[n] * double(shading.voxels[n]);
        count += body.voxels[n];
    }
    for (float& value : shading.voxels)
        value = std::clamp(float(value * count / sum), float(kLeastShading), float(kMostShading));
    return shading;
}

HuVolume evenedOut(HuVolume signal, const FieldVolume& shading)
{
    const auto& size = signal.grid.size;
    const auto weightsAlong = [&](std::size_t axis) {
        std::vector<std::pair<int, float>> at;  // the coarse voxel before, and the part of the one behind it
        for (int n = 0; n < size[axis]; ++n) {
            ContinuousIndex3 fine;
            (axis == 0 ? fine.i : axis == 1 ? fine.j : fine.k) = n;
            const ContinuousIndex3 c = shading.grid.continuousIndexAt(signal.grid.pointAt(fine));
            const double place = std::clamp(axis == 0   ? c.i
                                            : axis == 1 ? c.j
                                                        : c.k,
                                            0.0, shading.grid.size[axis] - 1.0);
            const int before = std::clamp(int(place), 0, std::max(0, shading.grid.size[axis] - 2));
            at.emplace_back(before, shading.grid.size[axis] > 1 ? float(place - before) : 0.0F);
        }
        return at;
    };
    const auto x = weightsAlong(0), y = weightsAlong(1), z = weightsAlong(2);
    const auto behind = [&](int n, std::size_t axis) { return std::min(n + 1, shading.grid.size[axis] - 1); };
    tbb::parallel_for(0, size[2], [&](int k) {
        const auto [before_z, part_z] = z[std::size_t(k)];
        for (int j = 0; j < size[1]; ++j) {
            const auto [before_y, part_y] = y[std::size_t(j)];
            const auto column = [&, by = before_y, py = part_y, bz = before_z, pz = part_z](int i) {
                const float low = std::lerp(shading.at({i, by, bz}), shading.at({i, behind(by, 1), bz}), py);
                const float high =
                    std::lerp(shading.at({i, by, behind(bz, 2)}), shading.at({i, behind(by, 1), behind(bz, 2)}), py);
                return std::lerp(low, high, pz);
            };
            std::int16_t* row = &signal.at({0, j, k});
            for (int i = 0; i < size[0]; ++i) {
                const auto [before_x, part_x] = x[std::size_t(i)];
                const float here = std::lerp(column(before_x), column(behind(before_x, 0)), part_x);
                if (row[i] != kPaddingHu)
                    row[i] = std::int16_t(std::clamp(std::lround(float(row[i]) / here), -1024L, 32767L));
            }
        }
    });
    return signal;
}

}  // namespace vicon::steps

#include "vicon/steps/noise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace vicon::steps {
namespace {

// No case recorded; reason: a cube of 8 mm holds 500 and more voxels, so its deviation is known to 3 %. Half or double
// of any of these keeps the lumen of the three cases (CONTRIBUTING.md) to Dice 0.9999.
constexpr double kCube_mm = 8;
constexpr double kSoftest_hu = 0, kHardest_hu = 100;
constexpr int kBins = 200;        // of 1 HU
constexpr int kBinSmoothing = 2;  // to either side
constexpr int kLeastCubes = 20;

struct Moments {
    double mean = 0, deviation = 0;
};

Moments momentsOf(const HuVolume& hu, Index3 first, int edge)
{
    std::int64_t sum = 0, squares = 0;
    for (int k = first.k; k < first.k + edge; ++k)
        for (int j = first.j; j < first.j + edge; ++j) {
            const std::int16_t* row = &hu.voxels[hu.grid.offset({first.i, j, k})];
            for (int i = 0; i < edge; ++i) {
                sum += row[i];
                squares += std::int64_t(row[i]) * row[i];
            }
        }
    const double count = double(edge) * edge * edge, mean = double(sum) / count;
    return {mean, std::sqrt(std::max(0.0, double(squares) / count - mean * mean))};
}

}  // namespace

double softTissueNoise(const HuVolume& hu)
{
    const int edge = std::max(4, int(std::lround(kCube_mm / hu.grid.spacing_mm[0])));
    const auto& size = hu.grid.size;
    std::array<std::atomic<int>, kBins> bins{};
    // Every second cube along rows and slices: thousands are left, and half of the volume is never read.
    tbb::parallel_for(0, size[2] / edge / 2 + 1, [&](int layer) {
        for (int k = 2 * layer * edge, j = 0; k + edge <= size[2] && j + edge <= size[1]; j += 2 * edge)
            for (int i = 0; i + edge <= size[0]; i += edge) {
                const Moments m = momentsOf(hu, {i, j, k}, edge);
                if (m.mean >= kSoftest_hu && m.mean <= kHardest_hu && m.deviation < kBins)
                    ++bins[std::size_t(m.deviation)];
            }
    });
    int cubes = 0, most = 0;
    for (const auto& bin : bins)
        cubes += bin;
    double noise_hu = 0;
    for (int n = 0; n < kBins && cubes >= kLeastCubes; ++n) {
        int near = 0;
        double weighted = 0;
        for (int m = std::max(0, n - kBinSmoothing); m <= std::min(kBins - 1, n + kBinSmoothing); ++m) {
            near += bins[std::size_t(m)];
            weighted += (m + 0.5) * bins[std::size_t(m)];
        }
        if (near > most) {
            most = near;
            noise_hu = weighted / near;
        }
    }
    return noise_hu;
}

}  // namespace vicon::steps

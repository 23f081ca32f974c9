#include "magnetic.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "densities.h"
#include "random.h"

namespace vicon::phantom {
namespace {

// About what a spoiled gradient echo with fat suppression and contrast medium in the wall shows.
constexpr double kAir = 4, kLung = 30, kFat = 180, kTissue = 420, kBone = 110;
constexpr double kDarkLumen = 40, kBrightLumen = 900;
constexpr double kShading = 1.9;

/// By the density of what lies in the voxel, away from the colon's lumen.
double signalOf(double hu)
{
    constexpr std::array<std::pair<double, double>, 7> kCurve{
        {{-1000, kAir}, {-900, kAir}, {-800, kLung}, {-110, kFat}, {-90, kFat}, {40, kTissue}, {150, kTissue}}};
    constexpr double kBone_hu = 350;
    if (hu >= kCurve.back().first)
        return std::lerp(kTissue, kBone, std::clamp((hu - kCurve.back().first) / (kBone_hu - 150), 0.0, 1.0));
    for (std::size_t n = 1; n < kCurve.size(); ++n)
        if (hu < kCurve[n].first)
            return std::lerp(kCurve[n - 1].second, kCurve[n].second,
                             std::max(0.0, (hu - kCurve[n - 1].first) / (kCurve[n].first - kCurve[n - 1].first)));
    return kTissue;
}

/// Within a voxel of the lumen there is nothing but it and its wall.
bool isNear(const InsideVolume& lumen, Index3 v)
{
    for (int dk = -1; dk <= 1; ++dk)
        for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di)
                if (lumen.valueOr({v.i + di, v.j + dj, v.k + dk}, kOutside) != kOutside)
                    return true;
    return false;
}

}  // namespace

HuVolume signalScene(const HuVolume& scene_hu, const InsideVolume& lumen, bool bright)
{
    const double filled = bright ? kBrightLumen : kDarkLumen;
    HuVolume signal(scene_hu.grid);
    tbb::parallel_for(0, signal.grid.size[2], [&](int k) {
        for (int j = 0; j < signal.grid.size[1]; ++j)
            for (int i = 0; i < signal.grid.size[0]; ++i) {
                const double hu = std::max(double(scene_hu.at({i, j, k})), kGas_hu);
                const double gas = std::clamp((kWall_hu - hu) / (kWall_hu - kGas_hu), 0.0, 1.0);
                const double value = isNear(lumen, {i, j, k}) ? std::lerp(kTissue, filled, gas) : signalOf(hu);
                signal.at({i, j, k}) = std::int16_t(std::lround(value));
            }
    });
    return signal;
}

void receive(HuVolume& signal, std::uint64_t study_seed, std::uint64_t noise_seed)
{
    Random draw(study_seed, "coils");
    std::array<double, 6> weights{};
    for (double& weight : weights)
        weight = draw.uniform(-1, 1);
    const auto& size = signal.grid.size;
    const std::size_t count = signal.grid.voxelCount();
    tbb::parallel_for(0, size[2], [&](int k) {
        const double z = 2.0 * k / size[2] - 1;
        for (int j = 0; j < size[1]; ++j) {
            const double y = 2.0 * j / size[1] - 1;
            for (int i = 0; i < size[0]; ++i) {
                const double x = 2.0 * i / size[0] - 1;
                const double shape = (weights[0] * x + weights[1] * y + weights[2] * z + weights[3] * x * y +
                                      weights[4] * (x * x - 0.5) + weights[5] * (z * z - 0.5)) /
                                     3;
                const double shaded = signal.at({i, j, k}) * std::exp(std::log(kShading) * shape);
                const std::size_t n = signal.grid.offset({i, j, k});
                const double real = shaded + kSignalNoise * whiteNoise(noise_seed, n);
                const double imaginary = kSignalNoise * whiteNoise(noise_seed, n + count);
                signal.at({i, j, k}) = std::int16_t(std::lround(std::hypot(real, imaginary)));
            }
        }
    });
}

}  // namespace vicon::phantom

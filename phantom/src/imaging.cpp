#include "imaging.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "random.h"

namespace vicon::phantom {
namespace {

/// The narrowest noise filter, in voxels: noise of a real reconstruction is correlated between neighbours.
constexpr double kLeastFilter = 0.6;

/// A sampled Gaussian; one half of it, the middle first; its sum over both sides is 1.
std::vector<float> gaussian(double sigma_voxels)
{
    if (sigma_voxels < 0.05)
        return {1.0F};
    const int reach = std::max(1, int(std::ceil(3.2 * sigma_voxels)));
    std::vector<double> weights;
    double sum = 0;
    for (int n = 0; n <= reach; ++n) {
        // Averaged over the voxel, so that narrow kernels keep their width.
        const double s = sigma_voxels * std::sqrt(2.0);
        weights.push_back(0.5 * (std::erf((n + 0.5) / s) - std::erf((n - 0.5) / s)));
        sum += (n == 0 ? 1 : 2) * weights.back();
    }
    std::vector<float> out;
    for (const double w : weights)
        out.push_back(float(w / sum));
    return out;
}

/// The same, and what a Gaussian of twice the width would blur away so many times more: edges overshoot.
std::vector<float> pointSpread(double sigma_voxels, double overshoot)
{
    std::vector<float> sharp = gaussian(sigma_voxels);
    if (overshoot <= 0)
        return sharp;
    const std::vector<float> soft = gaussian(2 * sigma_voxels);
    sharp.resize(std::max(sharp.size(), soft.size()), 0.0F);
    for (std::size_t n = 0; n < sharp.size(); ++n)
        sharp[n] = float((1 + overshoot) * sharp[n] - overshoot * (n < soft.size() ? soft[n] : 0.0F));
    return sharp;
}

/// Standard deviation of white noise after the filter.
double gain(const std::vector<float>& half)
{
    double sum = 0;
    for (std::size_t n = 0; n < half.size(); ++n)
        sum += (n == 0 ? 1.0 : 2.0) * half[n] * half[n];
    return std::sqrt(sum);
}

/// A run of values filtered along one direction; values beyond the ends repeat the last.
void filterRow(const float* in, float* out, int count, const std::vector<float>& half)
{
    const int reach = int(half.size()) - 1;
    for (int i = 0; i < count; ++i) {
        float sum = half[0] * in[i];
        if (i >= reach && i + reach < count)
            for (int n = 1; n <= reach; ++n)
                sum += half[std::size_t(n)] * (in[i - n] + in[i + n]);
        else
            for (int n = 1; n <= reach; ++n)
                sum += half[std::size_t(n)] * (in[std::max(0, i - n)] + in[std::min(count - 1, i + n)]);
        out[i] = sum;
    }
}

class Imager {
public:
    Imager(const HuVolume& scene, const ImagingOptions& options)
        : scene_(scene), seed_(Random(options.seed, "noise").bits()), nx_(scene.grid.size[0]), ny_(scene.grid.size[1])
    {
        const auto& spacing = scene.grid.spacing_mm;
        for (std::size_t a = 0; a < 3; ++a) {
            const double overshoot = a < 2 ? options.overshoot : 0;
            kernel_[a] = pointSpread(options.blur_mm / spacing[a], overshoot);
            noise_kernel_[a] = pointSpread(std::max(options.blur_mm / spacing[a], kLeastFilter), overshoot);
        }
        one_pass_ = kernel_ == noise_kernel_ || options.noise_hu <= 0;
        const double filtered = one_pass_ ? gain(kernel_[0]) * gain(kernel_[1]) * gain(kernel_[2])
                                          : gain(noise_kernel_[0]) * gain(noise_kernel_[1]) * gain(noise_kernel_[2]);
        amplitude_ = options.noise_hu / filtered;
    }

    void slab(int from, int to, HuVolume& out) const
    {
        std::vector<float> sum(plane());
        const int reach = int(std::max(kernel_[2].size(), noise_kernel_[2].size())) - 1;
        std::vector<std::vector<float>> ring(std::size_t(2 * reach + 1)), noise_ring(ring.size());
        int ready = from - reach;
        for (int k = from; k < to; ++k) {
            for (; ready <= k + reach; ++ready) {
                const std::size_t slot = std::size_t(ready + int(ring.size())) % ring.size();
                ring[slot] = inPlane(ready, true, one_pass_, kernel_);
                if (!one_pass_)
                    noise_ring[slot] = inPlane(ready, false, true, noise_kernel_);
            }
            std::fill(sum.begin(), sum.end(), 0.0F);
            addAcross(ring, k, kernel_[2], sum);
            if (!one_pass_)
                addAcross(noise_ring, k, noise_kernel_[2], sum);
            const std::size_t at = scene_.grid.offset({0, 0, k});
            for (std::size_t n = 0; n < plane(); ++n)
                out.voxels[at + n] = scene_.voxels[at + n] == kPaddingHu
                                         ? kPaddingHu
                                         : std::int16_t(std::clamp(std::lround(sum[n]), -1023L, 3071L));
        }
    }

private:
    std::size_t plane() const { return std::size_t(nx_) * std::size_t(ny_); }

    static void addAcross(const std::vector<std::vector<float>>& ring, int k, const std::vector<float>& half,
                          std::vector<float>& sum)
    {
        for (int n = -int(half.size()) + 1; n < int(half.size()); ++n) {
            const float weight = half[std::size_t(std::abs(n))];
            const auto& in = ring[std::size_t(k + n + int(ring.size())) % ring.size()];
            for (std::size_t m = 0; m < sum.size(); ++m)
                sum[m] += weight * in[m];
        }
    }

    std::vector<float> inPlane(int k, bool with_scene, bool with_noise,
                               const std::array<std::vector<float>, 3>& kernel) const
    {
        std::vector<float> a(plane(), 0.0F), b(plane());
        const std::size_t at = scene_.grid.offset({0, 0, std::clamp(k, 0, scene_.grid.size[2] - 1)});
        if (with_scene)
            for (std::size_t n = 0; n < plane(); ++n)
                a[n] = scene_.voxels[at + n] == kPaddingHu ? -1000.0F : float(scene_.voxels[at + n]);
        if (with_noise && amplitude_ > 0)
            addNoise(k, a);
        for (int j = 0; j < ny_; ++j)
            filterRow(&a[std::size_t(j) * std::size_t(nx_)], &b[std::size_t(j) * std::size_t(nx_)], nx_, kernel[0]);
        const int reach = int(kernel[1].size()) - 1;
        for (int j = 0; j < ny_; ++j) {
            float* out = &a[std::size_t(j) * std::size_t(nx_)];
            std::fill(out, out + nx_, 0.0F);
            for (int n = -reach; n <= reach; ++n) {
                const float* in = &b[std::size_t(std::clamp(j + n, 0, ny_ - 1)) * std::size_t(nx_)];
                const float weight = kernel[1][std::size_t(std::abs(n))];
                for (int i = 0; i < nx_; ++i)
                    out[i] += weight * in[i];
            }
        }
        return a;
    }

    void addNoise(int k, std::vector<float>& a) const
    {
        // Less towards the rim, where rays are shorter; least in the air around.
        for (int j = 0; j < ny_; ++j) {
            const double y = (2.0 * j / ny_ - 1), yy = y * y;
            for (int i = 0; i < nx_; ++i) {
                const double x = (2.0 * i / nx_ - 1);
                const auto strength = float(amplitude_ * (1.05 - 0.4 * (x * x + yy)));
                const std::size_t n = std::size_t(j) * std::size_t(nx_) + std::size_t(i);
                a[n] += strength * whiteNoise(seed_, std::uint64_t(k + 64) * plane() + n);
            }
        }
    }

    const HuVolume& scene_;
    std::uint64_t seed_;
    int nx_, ny_;
    std::array<std::vector<float>, 3> kernel_, noise_kernel_;
    bool one_pass_ = true;
    double amplitude_ = 0;
};

}  // namespace

HuVolume imageScene(const HuVolume& scene, const ImagingOptions& options, Progress& progress)
{
    constexpr int kSlab = 32;
    const Imager imager(scene, options);
    HuVolume out(scene.grid);
    const int slabs = (scene.grid.size[2] + kSlab - 1) / kSlab;
    tbb::parallel_for(0, slabs, [&](int n) {
        progress.check();
        imager.slab(n * kSlab, std::min(scene.grid.size[2], (n + 1) * kSlab), out);
    });
    return out;
}

}  // namespace vicon::phantom

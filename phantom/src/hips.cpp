#include "hips.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "random.h"

namespace vicon::phantom {
namespace {

constexpr double kHipsFrom_mm = 0, kHipsTo_mm = 85;  // heights of the hips, see Scene
constexpr int kCell = 2;                             // voxels of a slice to a cell of the plane that is projected
constexpr int kViews = 180;
constexpr double kWater_per_mm = 0.0195;  // attenuation at 70 keV
constexpr int kShownAsMetal_hu = 3000;    // what scans show of metal is cut off here
constexpr double kMetal_per_mm = 0.19;    // attenuation of cobalt and chromium
/// Photons of a ray through nothing. With as many, rays that lose less than kUsuallyLost reach the noise that scans
/// have everywhere; through both hips they lose 6.5 to 7.5.
constexpr double kPhotons = 1e5;
constexpr double kUsuallyLost = 5.5;
constexpr double kStarved = 9.5;      // no detector tells more
constexpr double kHardening = 0.025;  // of what metal takes from a ray, per unit of it

/// A square plane of cells, and the rays through it: one view after the other, a ray a cell's width.
class Plane {
public:
    Plane(int size, double cell_mm) : size_(size), cell_mm_(cell_mm), filter_(std::size_t(size))
    {
        for (int n = 0; n < size; ++n)  // the ramp, in space (Kak and Slaney, 1988, equation 3.61)
            filter_[std::size_t(n)] = n == 0 ? 0.25 / (cell_mm * cell_mm)
                                      : n % 2 != 0
                                          ? -1 / (std::numbers::pi * std::numbers::pi * n * n * cell_mm * cell_mm)
                                          : 0;
    }

    /// Integrals over mm along the rays of a view.
    std::vector<double> project(const std::vector<float>& cells, int view) const
    {
        const auto [c, s] = direction(view);
        std::vector<double> rays(static_cast<std::size_t>(size_), 0.0);
        for (int t = 0; t < size_; ++t)
            for (int along = 0; along < size_; ++along) {
                const double u = t - middle(), w = along - middle();
                rays[std::size_t(t)] += valueAt(cells, u * c - w * s + middle(), u * s + w * c + middle()) * cell_mm_;
            }
        return rays;
    }

    /// Filters a view's rays and adds them to the cells that they pass.
    void projectBack(const std::vector<double>& rays, int view, std::vector<float>& cells) const
    {
        const auto [c, s] = direction(view);
        const std::vector<double> sharp = filtered(rays);
        for (int j = 0; j < size_; ++j)
            for (int i = 0; i < size_; ++i) {
                const double t = (i - middle()) * c + (j - middle()) * s + middle();
                const int n = int(std::floor(t));
                if (n >= 0 && n + 1 < size_)
                    cells[cellAt(i, j)] += float(std::lerp(sharp[std::size_t(n)], sharp[std::size_t(n) + 1], t - n) *
                                                 std::numbers::pi / kViews);
            }
    }

    std::size_t cellCount() const { return std::size_t(size_) * std::size_t(size_); }
    int size() const { return size_; }
    std::size_t cellAt(int i, int j) const { return std::size_t(j) * std::size_t(size_) + std::size_t(i); }
    float valueAt(const std::vector<float>& cells, double x, double y) const
    {
        const int i = int(std::floor(x)), j = int(std::floor(y));
        if (i < 0 || j < 0 || i + 1 >= size_ || j + 1 >= size_)
            return 0;
        const float* at = &cells[cellAt(i, j)];
        const auto fx = float(x - i), fy = float(y - j);
        return (1 - fy) * (at[0] + fx * (at[1] - at[0])) + fy * (at[size_] + fx * (at[size_ + 1] - at[size_]));
    }

private:
    double middle() const { return (size_ - 1) / 2.0; }
    static std::pair<double, double> direction(int view)
    {
        const double angle = std::numbers::pi * view / kViews;
        return {std::cos(angle), std::sin(angle)};
    }
    std::vector<double> filtered(const std::vector<double>& rays) const
    {
        std::vector<double> out(rays.size(), 0.0);
        for (int n = 0; n < size_; ++n)
            for (int m = 0; m < size_; ++m)
                out[std::size_t(n)] += rays[std::size_t(m)] * filter_[std::size_t(std::abs(n - m))] * cell_mm_;
        return out;
    }

    int size_;
    double cell_mm_;
    std::vector<double> filter_;
};

/// What a ray is measured to lose beyond the truth.
double excess(double lost, double metal, double noise)
{
    const double hardened = lost - kHardening * metal * metal;
    const double unusual = std::max(0.0, std::exp(std::min(hardened, kStarved)) - std::exp(kUsuallyLost)) / kPhotons;
    return std::min(hardened + noise * std::sqrt(unusual), kStarved) - lost;
}

class HipSlice {
public:
    HipSlice(const HuVolume& hu, int k, const Plane& plane)
        : plane_(plane), lost_(plane.cellCount(), 0.0F), metal_(plane.cellCount(), 0.0F)
    {
        for (int j = 0; j < plane.size(); ++j)
            for (int i = 0; i < plane.size(); ++i)
                for (int n = 0; n < kCell * kCell; ++n) {
                    const std::int16_t v = hu.valueOr({i * kCell + n % kCell, j * kCell + n / kCell, k}, kPaddingHu);
                    const std::size_t cell = plane.cellAt(i, j);
                    const bool metal = v >= kShownAsMetal_hu;
                    has_metal_ = has_metal_ || metal;
                    const double per_mm = v == kPaddingHu ? 0
                                          : metal         ? kMetal_per_mm
                                                          : std::max(0.0, kWater_per_mm * (1 + v / 1000.0));
                    lost_[cell] += float(per_mm / (kCell * kCell));
                    metal_[cell] += metal ? float(kMetal_per_mm / (kCell * kCell)) : 0.0F;
                }
    }

    /// What is added to each cell's density, in HU.
    std::vector<float> artefacts(std::uint64_t seed) const
    {
        std::vector<float> cells(plane_.cellCount(), 0.0F);
        for (int view = 0; view < kViews; ++view) {
            std::vector<double> rays = plane_.project(lost_, view);
            const std::vector<double> metal = has_metal_ ? plane_.project(metal_, view) : std::vector(rays.size(), 0.0);
            for (std::size_t t = 0; t < rays.size(); ++t)
                rays[t] = excess(rays[t], metal[t], whiteNoise(seed, std::uint64_t(view) * rays.size() + t));
            plane_.projectBack(rays, view, cells);
        }
        for (float& v : cells)
            v *= float(1000 / kWater_per_mm);
        return cells;
    }

private:
    const Plane& plane_;
    std::vector<float> lost_, metal_;
    bool has_metal_ = false;
};

}  // namespace

void addHipArtefacts(HuVolume& hu, std::uint64_t seed, Progress& progress)
{
    const auto [nx, ny, nz] = hu.grid.size;
    const Plane plane((std::max(nx, ny) + kCell - 1) / kCell, hu.grid.spacing_mm[0] * kCell);
    const std::uint64_t stream = Random(seed, "hips").bits();
    tbb::parallel_for(0, nz, [&, nx = nx, ny = ny](int k) {
        const double height_mm = hu.grid.pointAt(Index3{nx / 2, ny / 2, k}).z;
        if (height_mm < kHipsFrom_mm || height_mm > kHipsTo_mm)
            return;
        progress.check();
        const std::vector<float> added = HipSlice(hu, k, plane).artefacts(mix(stream + std::uint64_t(k)));
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                if (std::int16_t& v = hu.at({i, j, k}); v != kPaddingHu) {
                    const double more = plane.valueAt(added, (i + 0.5) / kCell - 0.5, (j + 0.5) / kCell - 0.5);
                    v = std::int16_t(std::clamp(std::lround(v + more), -1023L, 3071L));
                }
    });
}

}  // namespace vicon::phantom

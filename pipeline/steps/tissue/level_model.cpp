#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tissue/levels.h"

namespace vicon::steps {
namespace {

// Held by tissue_test: levels against walls at 30 to 150 degrees, at a blur of 0.7 mm and a noise of 20 HU. Half and
// double of each move the wall of ctc-prone by 0.003 mm in the mean or less, kTelling by 0.020 mm; that of phantom 215
// by 0.004 mm or less.

/// The layer's half height, in sigma of its blur; beyond it the contents are pure.
constexpr double kLayer_sigmas = 3.2;
/// Where the contents' density is nearer to tissue than this part of what it is above or below the layer, what lies
/// above and below in the column tells more: a level a tenth of a voxel off makes a tenth of tissue there.
constexpr double kTelling = 0.8;
/// What the model may miss by, of the step, beside the noise: a tenth of a voxel's height.
constexpr double kMisfit = 0.06;
constexpr double kMissNoises = 4;
/// A wall under the layer that is no thicker than so many voxels is looked for: 2 mm.
constexpr int kWall_voxels = 3;

/// The fractions of one column's layer.
class Layer {
public:
    Layer(const Mixture& mixture, const DownAxis& down, double noise_hu)
        : mixture_(mixture), down_(down), noise_hu_(noise_hu)
    {
    }

    /// Calls set(voxel) for those that it set.
    template <class Set>
    void set(const LevelColumn& column, TissueVolume& tissue, Set set)
    {
        const int half = std::max(1, int(std::ceil(kLayer_sigmas * column.sigma / down_.upright)));
        voxels_.clear();
        for (int n = -half; n <= depthWithoutWall(column, half); ++n)
            if (const Index3 v = down_.moved(column.at, n); tissue.grid.contains(v))
                voxels_.push_back(measure(v, column));
        for (std::size_t n = 0; n < voxels_.size(); ++n)
            if (voxels_[n].fits || mixture_.inside.at(voxels_[n].at) != kOutside)
                if (const auto s = fraction(n)) {
                    tissue.at(voxels_[n].at) = stored(*s);
                    set(voxels_[n].at);
                }
    }

private:
    struct Voxel {
        Index3 at;
        TissueShare share;
        bool fits = false;  ///< its density lies between what the contents would have there and tissue's
    };

    /// How far below the plane, in voxels, the column may be read as lumen. Where gas comes again soon, a wall holds
    /// what stands over it, be it but a film: from where the density is highest the edge between that wall and gas
    /// tells.
    int depthWithoutWall(const LevelColumn& column, int half) const
    {
        const double wall_hu = (mixture_.gas_hu + mixture_.tissue_hu) / 2;
        int highest = 0;  // a wall over the gas is none
        double highest_hu = mixture_.hu(column.at);
        for (int n = 0; n <= half + kWall_voxels; ++n) {
            const double hu = mixture_.hu(down_.moved(column.at, n));
            if (n <= half && hu > highest_hu) {
                highest = n;
                highest_hu = hu;
            }
            if (hu < wall_hu && highest_hu > wall_hu)
                return highest - 1;
        }
        return half;
    }

    Voxel measure(Index3 v, const LevelColumn& column) const
    {
        const double step = column.fluid_hu - mixture_.gas_hu;
        const double below = (down_.depth(v) - column.depth) / column.sigma;
        const double content_hu = mixture_.gas_hu + step * 0.5 * std::erfc(-below / std::sqrt(2.0));
        const double hu = mixture_.hu(v);
        const double miss_hu = kMissNoises * noise_hu_ + kMisfit * step;
        Voxel voxel{.at = v};
        voxel.fits = hu > std::min(content_hu, mixture_.tissue_hu) - miss_hu &&
                     hu < std::max(content_hu, mixture_.tissue_hu) + miss_hu;
        voxel.share = tissueBeside(mixture_, hu, content_hu, column.fluid_hu);
        return voxel;
    }

    /// A voxel's own fraction as far as it tells, for the rest that between the nearest telling ones of the column.
    std::optional<double> fraction(std::size_t n) const
    {
        const Voxel& own = voxels_[n];
        const double weight = own.fits ? own.share.weight : 0;
        if (weight >= 1)
            return own.share.fraction;
        const auto [above, above_weight] = toldFrom(n, -1);
        const auto [below, below_weight] = toldFrom(n, 1);
        if (!own.fits && (above_weight <= 0 || below_weight <= 0))
            return std::nullopt;
        const double weights = above_weight + below_weight;
        return weights > 0 ? weight * own.share.fraction +
                                 (1 - weight) * (above * above_weight + below * below_weight) / weights
                           : own.share.fraction;
    }

    /// The fraction of the nearest telling voxel on one side, and how near it is; 0 where there is none.
    std::pair<double, double> toldFrom(std::size_t n, int step) const
    {
        for (auto m = std::ptrdiff_t(n) + step; m >= 0 && m < std::ptrdiff_t(voxels_.size()); m += step)
            if (const Voxel& other = voxels_[std::size_t(m)]; other.fits && other.share.weight >= 1)
                return {other.share.fraction, 1 / double(std::abs(m - std::ptrdiff_t(n)))};
        return {0, 0};
    }

    const Mixture& mixture_;
    const DownAxis& down_;
    double noise_hu_;
    std::vector<Voxel> voxels_;
};

}  // namespace

TissueShare tissueBeside(const Mixture& mixture, double hu, double content_hu, double fluid_hu)
{
    const double off_hu = mixture.tissue_hu - content_hu;
    const double telling_hu =
        kTelling * (off_hu > 0 ? mixture.tissue_hu - mixture.gas_hu : fluid_hu - mixture.tissue_hu);
    return {std::abs(off_hu) < 1 ? 0.5 : std::clamp((hu - content_hu) / off_hu, 0.0, 1.0),
            std::min(1.0, off_hu * off_hu / (telling_hu * telling_hu))};
}

std::size_t applyLevels(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels, double noise_hu,
                        TissueVolume& tissue)
{
    // Columns are taken one after the other where two levels' layers overlap: the later one, farther from its level's
    // own gas and fluid, must not undo the earlier.
    Layer layer(mixture, down, noise_hu);
    std::unordered_set<std::size_t> voxels;
    voxels.reserve(levels.columns.size() * 8);
    for (std::size_t n = levels.columns.size(); n-- > 0;)
        layer.set(levels.columns[n], tissue, [&](Index3 v) { voxels.insert(tissue.grid.offset(v)); });
    return voxels.size();
}

}  // namespace vicon::steps

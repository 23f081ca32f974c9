#include "tissue/sheets.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "grid/byte_rows.h"
#include "grid/neighbours.h"
#include "grid/sparse_voxels.h"
#include "tissue/mixture.h"
#include "vicon/core/disjoint_sets.h"

namespace vicon::steps {
namespace {

// Held by tissue_test: sheets of 0.8 to 2 mm in gas, fluid and through a level, at a blur of 0.7 mm and a noise of 0 to
// 30 HU. Half and double of kEndOfFaint move the wall of ctc-prone by 0.13 mm in the mean (1.4 % of the lumen), of
// kReach_mm, kThick, kSteepestSheet and kLeastRise by 0.06 to 0.08 mm, of the others by less than 0.02 mm; that of
// phantom 215 by 0.03 mm or less.

/// A sheet falls off to lumen on both sides within this.
constexpr double kReach_mm = 4;
/// The least rise of a sheet's middle over what lies on both sides: a wall of 0.45 mm at a blur of 0.7 mm has 0.25,
/// threads of mucus have less.
constexpr double kLeastRise = 0.25, kLeastRise_noises = 5;
/// The same in fluid: of its noise, which is more, smoothing has left less than half. Chosen on folds of 2 and 3 mm in
/// fluid of 300 HU at a noise of 30 to 70 HU: 1.3 leaves twice the shards, 3 takes a quarter more of the folds. Looked
/// at on phantom 816 (prone, 50 HU), where such shards hung from folds.
constexpr double kLeastRiseInFluid_noises = 2;
/// What lies on both sides of a sheet holds at most this part of its height: lumen.
constexpr float kFloor = 0.45F;
/// A sheet's middle lies at most half a voxel from its highest one, so from one side of that to the other the fraction
/// changes by at most this part of it, and less where the sheet is thicker than a faint one. What bulges from a wall
/// has lumen all around too, but falls from wall to lumen: by 0.9 of a faint one, by 0.55 of one of 0.85.
constexpr float kSteepestSheet = 0.7F, kFaint = 0.6F;
/// Of this fraction a wall is thick enough to keep its own place.
constexpr double kThick = 0.85;
/// Smaller sets of voxels are specks.
constexpr std::size_t kSmallest_voxels = 10;
/// Voxels around a sheet's middle that are scaled with it: its blurred flanks.
constexpr int kFlank_voxels = 3;
/// So many voxels of a sheet's middle lie in the 5 x 5 x 5 around each; of a thread of mucus a third.
constexpr int kSheet_voxels = 12;
/// A sheet's height is told from those of its voxels so near.
constexpr int kSheetReach_voxels = 2;
/// Passes of the mean over 3 x 3 x 3 voxels of what sheets are scaled by.
constexpr int kScalePasses = 2;
/// Part of its height at which a sheet fainter than half ends: 1.3 mm wide at a blur of 0.7 mm.
constexpr double kEndOfFaint = 0.65;

/// The level at which a blurred sheet of this height has its own width. The middle of a sheet of width w is erf(u), and
/// it is half of erf(2u) where it ends, with u = w / (sqrt(8) sigma).
double levelOf(double height)
{
    double u = 0;
    for (double step = 1; step > 1e-4; step /= 2)
        if (std::erf(u + step) < height)
            u += step;
    return std::min(0.5 * std::erf(2 * u), kEndOfFaint * height);
}

class Sheets {
public:
    Sheets(const InsideVolume& inside, const Stool& stool, const DownAxis& down, const FractionNoise& noise,
           const TissueVolume& tissue)
        : inside_(inside),
          stool_(stool),
          tissue_(tissue),
          reach_(std::max(2, int(kReach_mm / tissue.grid.spacing_mm[0]))),
          noise_(noise),
          least_(leastRise(kLeastRise_noises * noise.inGas())),
          down_(down)
    {
        const std::ptrdiff_t row = tissue.grid.size[0], slice = row * tissue.grid.size[1];
        for (std::size_t n = 0; n < kLines.size(); ++n)
            strides_[n] = kLines[n].i + kLines[n].j * row + kLines[n].k * slice;
    }

    /// The voxels along the middles of sheets, in order.
    std::vector<std::size_t> find() const
    {
        const auto [nx, ny, nz] = tissue_.grid.size;
        std::vector<std::vector<std::size_t>> slices(std::size_t(nz), std::vector<std::size_t>{});
        tbb::parallel_for(reach_, std::max(reach_, nz - reach_), [&, nx = nx, ny = ny](int k) {
            for (int j = reach_; j < ny - reach_; ++j) {
                const std::size_t begin = tissue_.grid.offset({0, j, k});
                const std::uint8_t* row = &tissue_.voxels[begin];
                for (int i = reach_; i < nx - reach_; ++i) {
                    if (row[i] == std::uint8_t(kWhole) || row[i] == 0) {
                        i = firstOther(row, i, nx - reach_, row[i]) - 1;
                        continue;
                    }
                    const float s = row[i];
                    if (s >= least_ && s <= kThick * kWhole && isRidge(begin + std::size_t(i)))
                        slices[std::size_t(k)].push_back(begin + std::size_t(i));
                }
            }
        });
        std::vector<std::size_t> all;
        for (const auto& slice : slices)
            all.insert(all.end(), slice.begin(), slice.end());
        return all;
    }

private:
    static constexpr std::uint8_t kStool = 3;  // a definition, beside the labels of an InsideVolume

    /// Whether it lies between lumen and lumen along a line, and is level along all.
    bool isRidge(std::size_t n) const
    {
        const std::uint8_t* at = &tissue_.voxels[n];
        const float height = float(at[0]) / kWhole;
        const float steepest = float(at[0]) * (kSteepestSheet - std::max(0.0F, height - kFaint));
        if (std::any_of(strides_.begin(), strides_.end(),
                        [&](std::ptrdiff_t step) { return std::abs(float(at[step]) - float(at[-step])) > steepest; }))
            return false;
        for (std::size_t line = 0; line < strides_.size(); ++line) {
            const std::ptrdiff_t step = strides_[line];
            if (at[step] > at[0] || at[-step] > at[0])
                continue;
            const std::uint8_t before = sideOf(n, -step, kLines[line]), after = sideOf(n, step, kLines[line]);
            if (before != kOutside && after != kOutside && !isLevel(kLines[line], before, after))
                return true;
        }
        return false;
    }

    /// Whether gas lies over fluid; under it a wall must be. Or beside stool.
    bool isLevel(Index3 line, std::uint8_t before, std::uint8_t after) const
    {
        if ((before == kStool && after == kGas) || (before == kGas && after == kStool))
            return true;
        const int downwards = down_.along(line) * down_.sign;
        return downwards > 0 ? before == kGas && after == kFluid : downwards < 0 && before == kFluid && after == kGas;
    }

    static float leastRise(double of_noise) { return float(kWhole * std::max(kLeastRise, of_noise)); }

    /// What noise there could make is no sheet.
    bool isBelow(float height, std::size_t side) const
    {
        if (inside_.voxels[side] != kFluid)
            return true;
        const double noise = noise_.inFluid(tissue_.grid.indexOf(side));
        return float(tissue_.voxels[side]) <= height - leastRise(kLeastRiseInFluid_noises * noise);
    }

    /// The label of the lumen that a sheet falls off to on one side, kStool or kOutside.
    std::uint8_t sideOf(std::size_t n, std::ptrdiff_t step, Index3 line) const
    {
        const double length = std::sqrt(double(line.i * line.i + line.j * line.j + line.k * line.k));
        const int steps = int(reach_ / length);
        const float floor = std::min(kFloor * float(tissue_.voxels[n]), float(tissue_.voxels[n]) - least_);
        for (int m = 1; m <= steps; ++m) {
            const auto p = std::size_t(std::ptrdiff_t(n) + m * step);
            if (tissue_.voxels[p] > tissue_.voxels[n])
                return kOutside;
            if (tissue_.voxels[p] <= floor && isBelow(float(tissue_.voxels[n]), p))
                return std::binary_search(stool_.dense.begin(), stool_.dense.end(), p) ? kStool : inside_.voxels[p];
        }
        return kOutside;
    }

    const InsideVolume& inside_;
    const Stool& stool_;
    const TissueVolume& tissue_;
    int reach_;
    const FractionNoise& noise_;
    float least_;  // beside gas
    const DownAxis& down_;
    std::array<std::ptrdiff_t, 13> strides_{};
};

/// Without the specks.
SparseVoxels connected(const SparseVoxels& middles)
{
    DisjointSets sets(middles.size());
    for (std::size_t n = 0; n < middles.size(); ++n)
        middles.forNear(middles[n], 1, [&](std::size_t other) { sets.join(std::uint32_t(n), std::uint32_t(other)); });
    std::vector<int> around(middles.size(), 0);
    tbb::parallel_for(std::size_t(0), middles.size(),
                      [&](std::size_t n) { middles.forNear(middles[n], 2, [&](std::size_t) { ++around[n]; }); });
    std::vector<std::size_t> sizes(middles.size(), 0);
    for (std::size_t n = 0; n < middles.size(); ++n)
        ++sizes[sets.rootOf(std::uint32_t(n))];
    // A sheet's rim has fewer around it, but the sheet beside it.
    const auto besideSheet = [&](std::size_t n) {
        bool found = false;
        middles.forNear(middles[n], 2, [&](std::size_t other) { found = found || around[other] >= kSheet_voxels; });
        return found;
    };
    std::vector<std::size_t> kept;
    for (std::size_t n = 0; n < middles.size(); ++n)
        if (sizes[sets.rootOf(std::uint32_t(n))] >= kSmallest_voxels && besideSheet(n))
            kept.push_back(middles[n]);
    return {middles.grid(), std::move(kept)};
}

/// The voxels in the blurred flanks of sheets, and for each the number of the middle that it is nearest to.
struct Flanks {
    SparseVoxels voxels;
    std::vector<std::uint32_t> middle;
};

Flanks flanksOf(const SparseVoxels& middles)
{
    const Grid& grid = middles.grid();
    const auto [nx, ny, nz] = grid.size;
    const auto slice = std::size_t(nx) * std::size_t(ny);
    constexpr std::uint32_t kNone = ~0U;  // no middle is near
    constexpr int kNumberBits = 28;       // below the squared distance: the nearest middle is the least
    std::vector<std::vector<std::size_t>> voxels(std::size_t(nz), std::vector<std::size_t>{});
    std::vector<std::vector<std::uint32_t>> numbers(std::size_t(nz), std::vector<std::uint32_t>{});
    tbb::parallel_for(tbb::blocked_range<int>(0, nz), [&, nx = nx, ny = ny](const tbb::blocked_range<int>& slices) {
        std::vector<std::uint32_t> nearest(slice, kNone);
        for (int k = slices.begin(); k < slices.end(); ++k) {
            const auto [first, last] = middles.inSlices(k - kFlank_voxels, k + kFlank_voxels + 1);
            for (std::size_t n = first; n < last; ++n) {
                const Index3 v = grid.indexOf(middles[n]);
                for (int j = std::max(0, v.j - kFlank_voxels); j <= std::min(ny - 1, v.j + kFlank_voxels); ++j)
                    for (int i = std::max(0, v.i - kFlank_voxels); i <= std::min(nx - 1, v.i + kFlank_voxels); ++i) {
                        const int away2 = (i - v.i) * (i - v.i) + (j - v.j) * (j - v.j) + (k - v.k) * (k - v.k);
                        if (away2 > kFlank_voxels * kFlank_voxels + 1)
                            continue;
                        std::uint32_t& found = nearest[std::size_t(i) + std::size_t(j) * std::size_t(nx)];
                        found = std::min(found, std::uint32_t(away2) << kNumberBits | std::uint32_t(n));
                    }
            }
            if (first == last)
                continue;
            for (std::size_t n = 0; n < slice; ++n)
                if (nearest[n] != kNone) {
                    voxels[std::size_t(k)].push_back(std::size_t(k) * slice + n);
                    numbers[std::size_t(k)].push_back(nearest[n] & ((1U << kNumberBits) - 1));
                    nearest[n] = kNone;
                }
        }
    });
    std::vector<std::size_t> all;
    std::vector<std::uint32_t> middle;
    for (std::size_t k = 0; k < voxels.size(); ++k) {
        all.insert(all.end(), voxels[k].begin(), voxels[k].end());
        middle.insert(middle.end(), numbers[k].begin(), numbers[k].end());
    }
    return {SparseVoxels(grid, std::move(all)), std::move(middle)};
}

/// Of the 3 x 3 x 3 voxels around one.
std::uint8_t binomialMean(const TissueVolume& tissue, std::size_t voxel)
{
    const Index3 v = tissue.grid.indexOf(voxel);
    const auto weight = [](int a, int b) { return 2 - std::abs(a - b); };
    int sum = 0;
    forEachInCube(v, 1, [&](Index3 w) {
        sum += weight(w.i, v.i) * weight(w.j, v.j) * weight(w.k, v.k) * tissue.valueOr(w, std::uint8_t(kWhole));
    });
    return std::uint8_t((sum + 32) / 64);
}

/// Takes noise from sheets. It widens them as blur does, which their heights then tell.
void smooth(const SparseVoxels& flanks, TissueVolume& tissue)
{
    std::vector<std::uint8_t> smoothed(flanks.size());
    tbb::parallel_for(std::size_t(0), flanks.size(),
                      [&](std::size_t n) { smoothed[n] = binomialMean(tissue, flanks[n]); });
    for (std::size_t n = 0; n < flanks.size(); ++n)
        tissue.voxels[flanks[n]] = smoothed[n];
}

/// The height of the sheet that each middle belongs to. It lies between voxels: so that of the highest beside it, and
/// of those the mean, for noise differs from voxel to voxel.
std::vector<float> heightsOf(const SparseVoxels& middles, const TissueVolume& tissue)
{
    std::vector<float> highest(middles.size(), 0), heights(middles.size());
    tbb::parallel_for(std::size_t(0), middles.size(), [&](std::size_t n) {
        middles.forNear(middles[n], 1, [&](std::size_t other) {
            highest[n] = std::max(highest[n], tissue.voxels[middles[other]] / kWhole);
        });
    });
    tbb::parallel_for(std::size_t(0), middles.size(), [&](std::size_t n) {
        float sum = 0, count = 0;
        middles.forNear(middles[n], kSheetReach_voxels, [&](std::size_t other) {
            sum += highest[other];
            ++count;
        });
        heights[n] = sum / count;
    });
    return heights;
}

/// What a sheet of a height is multiplied by.
class Scale {
public:
    Scale()
    {
        for (std::size_t n = 1; n < scales_.size(); ++n)
            scales_[n] = std::max(1.0F, float(0.5 / levelOf(double(n) / kSteps)));
    }
    float of(float height) const { return scales_[std::size_t(std::lround(height * kSteps))]; }

private:
    static constexpr int kSteps = 256;  // of a height from 0 to 1: finer than the bytes of a fraction
    std::array<float, kSteps + 1> scales_{};
};

/// What each flank's fraction is multiplied by, evened out over its neighbours, so that a sheet's rim is none of where
/// it was just found; 1 beyond the flanks.
std::vector<float> scalesOf(const Flanks& flanks, const std::vector<float>& heights)
{
    const Scale scale;
    const SparseVoxels& voxels = flanks.voxels;
    std::vector<float> scales(voxels.size()), before;
    std::transform(flanks.middle.begin(), flanks.middle.end(), scales.begin(),
                   [&](std::uint32_t middle) { return scale.of(heights[middle]); });
    for (int pass = 0; pass < kScalePasses; ++pass) {
        before = scales;
        tbb::parallel_for(std::size_t(0), voxels.size(), [&](std::size_t n) {
            float sum = 0, count = 0;
            voxels.forNear(voxels[n], 1, [&](std::size_t other) {
                sum += before[other];
                ++count;
            });
            scales[n] = (sum + (27 - count)) / 27;
        });
    }
    return scales;
}

}  // namespace

SheetsFound keepSheets(const InsideVolume& inside, const Stool& stool, const DownAxis& down, const FractionNoise& noise,
                       TissueVolume& tissue)
{
    const SparseVoxels middles =
        connected(SparseVoxels(tissue.grid, Sheets(inside, stool, down, noise, tissue).find()));
    SheetsFound found{.ridge_voxels = middles.size()};
    for (std::size_t n = 0; n < middles.size(); ++n)
        found.faint_voxels += tissue.voxels[middles[n]] < kWhole / 2 ? 1 : 0;
    const Flanks flanks = flanksOf(middles);
    smooth(flanks.voxels, tissue);
    const std::vector<float> scales = scalesOf(flanks, heightsOf(middles, tissue));
    for (std::size_t n = 0; n < flanks.voxels.size(); ++n) {
        std::uint8_t& fraction = tissue.voxels[flanks.voxels[n]];
        fraction = stored(fraction / kWhole * scales[n]);
    }
    return found;
}

}  // namespace vicon::steps

#include "tissue/meniscus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vicon::steps {
namespace {

// Held by tissue_levels_test: fluid that is a plane, and that rises by 1 mm, against walls at 30 to 150 degrees, folds,
// balls and polyps. kMeniscus_mm, kFits_hu and kFitsNot_hu chosen on those, which miss by less than 50 HU, and on
// ctc-prone at 425 to 500 mm, where gas lies flat under a ceiling, its ends are round, and it is 60 to 140 HU.

/// Fluid rises along a wall: water along one that it wets by up to 3.8 mm, along mucosa by less. Where nothing tells
/// better, so far above its level fluid or gas may be beside tissue.
constexpr double kMeniscus_mm = 1.2;
/// A place that fits at no height says no more than this.
constexpr float kMost_hu = 300;
/// Fewer places than this tell nothing.
constexpr double kFewestPlaces = 200;
/// Water beside a wall that it wets rises by 2.7 mm a radian; what clings to mucosa by much less.
constexpr double kMostPerRadian_mm = 0.6;
/// Both are sought in so many parts: of 0.05 mm.
constexpr int kSlopes = 12, kPartsOfHeight = 6;
/// Places are asked together in cells of this edge, each with those around it: 12 mm.
constexpr int kCell_voxels = 6;
/// So many of the scan's places are asked with them.
constexpr double kOfScan = 20;
/// Densities that miss by less, beside the noise, fit what is usual in the scan; those that miss by more do not.
constexpr double kFits_hu = 40, kFitsNot_hu = 70;
/// The mean size of Gaussian noise, of its standard deviation.
constexpr double kMeanOfNoise = 0.8;

Index3 cellOf(Index3 v)
{
    return {v.i / kCell_voxels, v.j / kCell_voxels, v.k / kCell_voxels};
}

std::size_t keyOf(Index3 cell)
{
    constexpr std::size_t kMost = 1U << 20U;  // along an axis, with one before the first
    return std::size_t(cell.i + 1) + kMost * (std::size_t(cell.j + 1) + kMost * std::size_t(cell.k + 1));
}

/// A cell with those around it.
MeniscusFit fitAround(Index3 cell, const std::unordered_map<std::size_t, MeniscusFit>& cells)
{
    MeniscusFit around;
    for (int dk = -1; dk <= 1; ++dk)
        for (int dj = -1; dj <= 1; ++dj)
            for (int di = -1; di <= 1; ++di)
                if (const auto found = cells.find(keyOf({cell.i + di, cell.j + dj, cell.k + dk})); found != cells.end())
                    around.add(found->second, 1);
    return around;
}

}  // namespace

void MeniscusFit::add(const MeniscusPlace& place)
{
    const double part = place.overhang / std::numbers::pi + 0.5;
    const auto lean = std::size_t(std::clamp(int(part * kLeans), 0, int(kLeans) - 1));
    ++places_[lean];
    for (std::size_t n = 0; n < place.misses_hu.size(); ++n)
        misses_hu_[lean][n] += double(std::min(place.misses_hu[n], kMost_hu));
}

void MeniscusFit::add(const MeniscusFit& other, double weight)
{
    for (std::size_t lean = 0; lean < kLeans; ++lean) {
        places_[lean] += weight * other.places_[lean];
        for (std::size_t n = 0; n < MeniscusPlace::kHeights; ++n)
            misses_hu_[lean][n] += weight * other.misses_hu_[lean][n];
    }
}

double MeniscusFit::places() const
{
    double places = 0;
    for (const double count : places_)
        places += count;
    return places;
}

/// Between heights by a parabola, beyond them that of the last.
double MeniscusFit::missOf_hu(std::size_t lean, double rise_mm) const
{
    constexpr std::size_t kLast = MeniscusPlace::kHeights - 1;  // of the heights tried
    const double at = std::clamp((rise_mm - MeniscusPlace::kLowest_mm) / MeniscusPlace::kStep_mm, 0.0, double(kLast));
    const auto middle = std::clamp(std::size_t(std::lround(at)), std::size_t(1), kLast - 1);
    const auto& misses_hu = misses_hu_[lean];
    const double t = at - double(middle), here = misses_hu[middle], below = misses_hu[middle - 1],
                 above = misses_hu[middle + 1];
    return here + t * (above - below) / 2 + t * t * (above + below - 2 * here) / 2;
}

double MeniscusFit::missOf_hu(const MeniscusShape& meniscus) const
{
    double miss_hu = 0;
    for (std::size_t lean = 0; lean < kLeans; ++lean)
        miss_hu += missOf_hu(lean, meniscus.rise_mm(std::numbers::pi * ((double(lean) + 0.5) / kLeans - 0.5)));
    return miss_hu;
}

MeniscusShape MeniscusFit::best() const
{
    MeniscusShape best;
    double least_hu = std::numeric_limits<double>::max();
    for (int slope = 0; slope <= kSlopes; ++slope)
        for (int part = 0; part <= kPartsOfHeight * int(MeniscusPlace::kHeights - 1); ++part) {
            const MeniscusShape meniscus{MeniscusPlace::kLowest_mm + part * MeniscusPlace::kStep_mm / kPartsOfHeight,
                                         slope * kMostPerRadian_mm / kSlopes};
            if (const double miss_hu = missOf_hu(meniscus); miss_hu < least_hu) {
                least_hu = miss_hu;
                best = meniscus;
            }
        }
    return best;
}

Menisci::Menisci(const LevelVoxels& voxels, const std::vector<std::optional<MeniscusPlace>>& places, double noise_hu)
    : known_(true)
{
    MeniscusFit whole;
    std::unordered_map<std::size_t, MeniscusFit> cells;
    for (std::size_t n = 0; n < voxels.size(); ++n)
        if (places[n]) {
            whole.add(*places[n]);
            cells[keyOf(cellOf(voxels[n].at))].add(*places[n]);
        }
    if (whole.places() < kFewestPlaces)
        return;
    usual_ = whole.best();
    std::unordered_map<std::size_t, float> may_rise_mm;
    for (std::size_t n = 0; n < voxels.size(); ++n) {
        const Index3 cell = cellOf(voxels[n].at);
        const auto [here, is_new] = may_rise_mm.try_emplace(keyOf(cell));
        if (!is_new)
            continue;
        MeniscusFit around = fitAround(cell, cells);
        around.add(whole, kOfScan / whole.places());
        const double miss_hu = around.missOf_hu(usual_) / around.places(), noisy_hu = kMeanOfNoise * noise_hu;
        const double beside_noise_hu = std::sqrt(std::max(0.0, miss_hu * miss_hu - noisy_hu * noisy_hu));
        here->second =
            float(kMeniscus_mm * std::clamp((beside_noise_hu - kFits_hu) / (kFitsNot_hu - kFits_hu), 0.0, 1.0));
    }
    may_rise_mm_ = std::move(may_rise_mm);
}

double Menisci::mayRise_mm(Index3 v, double overhang) const
{
    if (!known_)
        return kMeniscus_mm;
    const double usual_mm = usual_.rise_mm(overhang);
    const auto found = may_rise_mm_.find(keyOf(cellOf(v)));
    return found == may_rise_mm_.end() ? usual_mm : std::max(usual_mm, double(found->second));
}

}  // namespace vicon::steps

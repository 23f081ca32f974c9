#include "tissue/level_wall.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "tissue/level_planes.h"
#include "tissue/meniscus.h"

namespace vicon::steps {
namespace {

// Chosen in two dimensions, on walls at 20 to 150 degrees, folds, balls and tubes at a level, at a blur of a voxel and
// a noise of 20 HU; kUncertain and kRounds on ctc-prone at 350 to 550 mm. Held by tissue_levels_test.
constexpr int kRounds = 4;
/// The fraction's rise over a voxel that makes a wall.
constexpr double kLevelWallSlope = 0.08;
/// Below it no wall leads on, and the way is straight.
constexpr double kLeastSlope = 0.03;
/// How steeply the lumen ends at the wall found, before it is blurred, per fraction.
constexpr float kSharper = 2;
/// What tells is sought this far along the wall, step by step, in voxels.
constexpr double kFarthest_voxels = 6, kStep_voxels = 0.5;
/// A place tells from this weight on.
constexpr double kTells = 0.9;
/// A wall that lies flatter than 9 degrees leads nowhere below or above.
constexpr double kFlattest = 0.15;
/// So far from the plane, in voxels, the labels know whether gas or fluid is there: another level may be near.
constexpr float kLabelled_voxels = 1.5F;
/// Where fluid that may have risen changes the fraction by so much, a voxel tells nothing.
constexpr double kUncertain = 0.25;
/// So far above and below its level a place tells how fluid stands there, where so much of it is neither lumen nor
/// tissue.
constexpr double kBeside_voxels = 3.2, kMixed = 0.02;
/// The reach of the blur, in voxels squared: 2.4 of them, which are sigmas.
constexpr int kReach_voxels2 = 6;
/// Voxels so near to the border of the scan are left as they are.
constexpr int kBorder_voxels = 3;
/// What there must be of lumen around a voxel, blurred, for its contents to be known from it.
constexpr float kLeastLumen = 0.05F;

class Wall {
public:
    Wall(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels, const LevelVoxels& voxels,
         double noise_hu, TissueVolume& tissue)
        : mixture_(mixture),
          down_(down),
          levels_(levels),
          planes_(settledPlanes(mixture, down, levels, voxels, tissue)),
          noise_hu_(noise_hu),
          voxel_mm_(tissue.grid.spacing_mm[std::size_t(down.axis)]),
          voxels_(voxels),
          tissue_(tissue),
          known_(voxels.size())
    {
        for (int dk = -2; dk <= 2; ++dk)
            for (int dj = -2; dj <= 2; ++dj)
                for (int di = -2; di <= 2; ++di)
                    if (const int squared = di * di + dj * dj + dk * dk; squared <= kReach_voxels2)
                        taps_.push_back({stepBy(di, dj, dk), float(down.depth({di, dj, dk})), squared});
        for (std::size_t n = 0; n < voxels.size(); ++n)
            known_[n].by_column = tissue.at(voxels[n].at);
    }

    void refine()
    {
        for (int round = 0; round < kRounds; ++round) {
            forAll([&](std::size_t n) { known_[n] = knownOf(n); });
            if (round == 0) {
                findMenisci();
                forAll([&](std::size_t n) { known_[n] = knownOf(n); });
            }
            std::vector<std::uint8_t> values(voxels_.size());
            forAll([&](std::size_t n) { values[n] = valueOf(n); });
            forAll([&](std::size_t n) { tissue_.at(voxels_[n].at) = values[n]; });
        }
    }

private:
    /// Of one level voxel, with the tissue found so far.
    struct Known {
        Vector3 slope;               ///< of the fraction
        double fraction = 0;         ///< of fluid that stands as is usual in the scan
        double telling = 1;          ///< 1 where the density tells that fraction, 0 where it tells nothing
        double certain = 1;          ///< 1 where fluid that has risen would not change it, 0 where it would
        std::uint8_t by_column = 0;  ///< what applyLevels() found
    };
    /// The same between voxels.
    struct Sample {
        Vector3 slope;
        double weight = 0, weighted = 0;  ///< weight, and fraction times weight
    };

    /// A voxel beside another.
    struct Tap {
        std::ptrdiff_t step;
        float depth;
        int squared;  ///< distance
    };
    std::ptrdiff_t stepBy(int di, int dj, int dk) const
    {
        const std::ptrdiff_t row = tissue_.grid.size[0];
        return di + row * (dj + std::ptrdiff_t(tissue_.grid.size[1]) * dk);
    }

    template <class Use>
    void forAll(Use use) const
    {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, voxels_.size(), 1 << 10), [&](const auto& part) {
            for (std::size_t n = part.begin(); n < part.end(); ++n)
                use(n);
        });
    }

    Known knownOf(std::size_t n) const
    {
        Known known{.slope = slopeAt(voxels_[n].at), .by_column = known_[n].by_column};
        if (length(known.slope) <= kLevelWallSlope) {
            known.fraction = known.by_column / double(kWhole);
            return known;
        }
        const Index3 v = voxels_[n].at;
        const LevelColumn& column = levels_.columns[voxels_[n].column];
        const double step_hu = column.fluid_hu - mixture_.gas_hu, hu = mixture_.hu(v);
        const double overhang = overhangOf(known.slope), rise_mm = menisci_.usual().rise_mm(overhang),
                     most_mm = menisci_.mayRise_mm(v, overhang);
        const auto content_hu = [&](double risen_mm) {
            return mixture_.gas_hu +
                   step_hu * fluidShare(v, column, planes_[voxels_[n].column], float(risen_mm / voxel_mm_));
        };
        const TissueShare share = tissueBeside(mixture_, hu, content_hu(rise_mm), column.fluid_hu);
        known.fraction = share.fraction;
        known.telling = share.weight;
        if (most_mm > rise_mm)
            known.certain = std::clamp(
                1 - std::abs(share.fraction - fractionBeside(hu, content_hu(most_mm))) / kUncertain, 0.0, 1.0);
        return known;
    }

    /// The fraction where fluid has risen. What then has not even the density of its contents holds no tissue.
    double fractionBeside(double hu, double content_hu) const
    {
        if (hu < mixture_.tissue_hu)
            return content_hu < hu ? mixture_.fraction(hu, content_hu) : 0;
        return content_hu > hu ? mixture_.fraction(hu, content_hu) : 0;
    }

    /// How far a wall hangs over what it holds: radians from upright.
    double overhangOf(Vector3 slope) const
    {
        const double steepness = length(slope);
        return steepness > 0 ? -std::asin(std::clamp(dot(slope, down_way_) / steepness, -1.0, 1.0)) : 0;
    }

    /// What fluid is of the contents of the lumen found so far, blurred.
    /// @param rise of its level above the plane, in voxels
    double fluidShare(Index3 v, const LevelColumn& column, double plane, float rise) const
    {
        std::array<float, kReach_voxels2 + 1> blur{};
        for (int n = 0; n <= kReach_voxels2; ++n)
            blur[std::size_t(n)] = std::exp(-0.5F * float(n) / (column.sigma * column.sigma));
        const std::size_t at = tissue_.grid.offset(v);
        const float below_plane = float(down_.depth(v) - plane);
        float fluid = 0, lumen = 0, all = 0;
        for (const Tap& tap : taps_) {
            const std::size_t u = std::size_t(std::ptrdiff_t(at) + tap.step);
            const float weight = blur[std::size_t(tap.squared)], part = weight * lumenIn(u);
            all += weight;
            lumen += part;
            fluid += part * fluidIn(u, below_plane + tap.depth, rise);
        }
        if (lumen > kLeastLumen * all)
            return fluid / lumen;
        return 0.5 * std::erfc(-(below_plane + rise) / column.sigma / std::sqrt(2.0F));
    }

    void findMenisci()
    {
        std::vector<std::optional<MeniscusPlace>> places(voxels_.size());
        forAll([&](std::size_t n) { places[n] = placeAt(n); });
        menisci_ = Menisci(voxels_, places, noise_hu_);
    }

    /// What a voxel beside a wall says of how high fluid stands there.
    std::optional<MeniscusPlace> placeAt(std::size_t n) const
    {
        const Index3 v = voxels_[n].at;
        const LevelColumn& column = levels_.columns[voxels_[n].column];
        const double plane = planes_[voxels_[n].column];
        if (length(known_[n].slope) <= kLevelWallSlope || std::abs(down_.depth(v) - plane) > kBeside_voxels)
            return std::nullopt;
        const auto above = toldAlongWall(v, -1), below = toldAlongWall(v, 1);
        if (!above || !below)
            return std::nullopt;
        const double fraction =
            (above->first * above->second + below->first * below->second) / (above->second + below->second);
        if (fraction < kMixed || fraction > 1 - kMixed)
            return std::nullopt;
        const double step_hu = column.fluid_hu - mixture_.gas_hu;
        MeniscusPlace place{.overhang = overhangOf(known_[n].slope)};
        for (std::size_t height = 0; height < place.misses_hu.size(); ++height) {
            const float rise = float(MeniscusPlace::height_mm(height) / voxel_mm_);
            const double content_hu = mixture_.gas_hu + step_hu * fluidShare(v, column, plane, rise);
            place.misses_hu[height] =
                float(std::abs(mixture_.hu(v) - fraction * mixture_.tissue_hu - (1 - fraction) * content_hu));
        }
        return place;
    }

    /// How much of a voxel is lumen, before it is blurred.
    float lumenIn(std::size_t u) const
    {
        return std::clamp(0.5F + kSharper * (0.5F - float(tissue_.voxels[u]) / kWhole), 0.0F, 1.0F);
    }

    /// How much of a voxel's lumen is fluid, so far below the plane.
    /// @param rise of its level above the plane
    float fluidIn(std::size_t u, float below, float rise) const
    {
        if (std::abs(below) > kLabelled_voxels + std::abs(rise))
            if (const std::uint8_t label = mixture_.inside.voxels[u]; label != kOutside)
                return label == kFluid ? 1 : 0;
        return std::clamp(below + rise + 0.5F, 0.0F, 1.0F);
    }

    /// The mean over the nine lines beside each other, of tissue found so far.
    Vector3 slopeAt(Index3 v) const
    {
        if (!isInner(v))
            return {};
        const std::uint8_t* const at = &tissue_.at(v);
        const std::ptrdiff_t row = tissue_.grid.size[0], slice = row * tissue_.grid.size[1];
        int x = 0, y = 0, z = 0;
        for (int dk = -1; dk <= 1; ++dk)
            for (int dj = -1; dj <= 1; ++dj) {
                const std::uint8_t* const three = at + dj * row + dk * slice;
                const int wj = 2 - dj * dj, wk = 2 - dk * dk, sum = three[-1] + 2 * three[0] + three[1];
                x += wj * wk * (three[1] - three[-1]);
                y += dj * wk * sum;
                z += dk * wj * sum;
            }
        constexpr double kUnit = 1 / (32 * double(kWhole));  // of the weights above, for a rise a voxel
        return {x * kUnit, y * kUnit, z * kUnit};
    }

    /// Whether all that is asked for around a voxel is there.
    bool isInner(Index3 v) const
    {
        const auto& size = tissue_.grid.size;
        return std::min({v.i, v.j, v.k, size[0] - 1 - v.i, size[1] - 1 - v.j, size[2] - 1 - v.k}) >= kBorder_voxels;
    }

    Sample sampleAt(ContinuousIndex3 p) const
    {
        const Index3 first{int(std::floor(p.i)), int(std::floor(p.j)), int(std::floor(p.k))};
        const double fi = p.i - first.i, fj = p.j - first.j, fk = p.k - first.k;
        Sample sample;
        for (int corner = 0; corner < 8; ++corner) {
            const int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
            const double part = (di ? fi : 1 - fi) * (dj ? fj : 1 - fj) * (dk ? fk : 1 - fk);
            const Index3 v{first.i + di, first.j + dj, first.k + dk};
            if (!tissue_.grid.contains(v))
                continue;
            const auto n = voxels_.find(v);
            const Vector3 slope = n ? known_[*n].slope : slopeAt(v);
            const double weight = n ? known_[*n].telling * known_[*n].certain : 1;
            const double fraction = n ? known_[*n].fraction : tissue_.at(v) / double(kWhole);
            sample.slope = sample.slope + slope * part;
            sample.weight += part * weight;
            sample.weighted += part * weight * fraction;
        }
        return sample;
    }

    /// The fraction at the nearest place along the wall that tells, up or down, and how near it is.
    std::optional<std::pair<double, double>> toldAlongWall(Index3 v, double sign) const
    {
        ContinuousIndex3 p{double(v.i), double(v.j), double(v.k)};
        Vector3 way = down_way_ * sign;
        Sample here = sampleAt(p);
        for (double gone = kStep_voxels; gone <= kFarthest_voxels; gone += kStep_voxels) {
            if (const double slope = length(here.slope); slope > kLeastSlope) {
                const Vector3 normal = here.slope * (1 / slope);
                way = way - normal * dot(way, normal);
                if (length(way) < kFlattest)
                    return std::nullopt;
                way = normalized(way);
            }
            p = {p.i + kStep_voxels * way.x, p.j + kStep_voxels * way.y, p.k + kStep_voxels * way.z};
            here = sampleAt(p);
            if (here.weight > kTells)
                return std::pair(here.weighted / here.weight, 1 / gone);
        }
        return std::nullopt;
    }

    std::uint8_t valueOf(std::size_t n) const
    {
        const Known& known = known_[n];
        if (length(known.slope) <= kLevelWallSlope)
            return known.by_column;
        if (known.telling >= 1 && known.certain >= 1)
            return stored(known.fraction);
        const auto above = toldAlongWall(voxels_[n].at, -1), below = toldAlongWall(voxels_[n].at, 1);
        double told = 0, nearness = 0;
        for (const auto& side : {above, below})
            if (side) {
                told += side->first * side->second;
                nearness += side->second;
            }
        if (nearness <= 0)
            return known.by_column;
        const double own = known.telling * known.certain;
        return stored(own * known.fraction + (1 - own) * told / nearness);
    }

    const Mixture& mixture_;
    const DownAxis& down_;
    const Vector3 down_way_ = normalized(down_.per_voxel);
    const FluidLevels& levels_;
    std::vector<float> planes_;  ///< of each column
    double noise_hu_;
    double voxel_mm_;  ///< along the axis nearest to gravity
    Menisci menisci_;
    const LevelVoxels& voxels_;
    TissueVolume& tissue_;
    std::vector<Tap> taps_;
    std::vector<Known> known_;
};

}  // namespace

void refineAtWall(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels, const LevelVoxels& voxels,
                  double noise_hu, TissueVolume& tissue)
{
    Wall(mixture, down, levels, voxels, noise_hu, tissue).refine();
}

}  // namespace vicon::steps

#include "vicon/cases/density_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon {
namespace {

constexpr double kLeastRadius_mm = 0.5, kMostRadius_mm = 25;
/// Beyond a straight border between gas and tissue (-1000 and 40 HU) blurred with a sigma of 0.8 mm, the widest that
/// the phantom draws and that of a soft kernel, the error is 6 HU at 2.5 sigma.
constexpr double kMargin_mm = 2;
constexpr double kMarginVoxels = 1.5;
constexpr int kFatFrom_hu = -200, kFatTo_hu = -30;

/// A ball's voxels, and the lumen in and around them.
class Surroundings {
public:
    Surroundings(const HuView& volume, const InsideView& inside, Point3 centre, double radius_mm, double margin_mm,
                 const Progress* wanted)
        : volume_(&volume), wanted_(wanted), centre_(centre), radius_mm_(radius_mm)
    {
        const Index3 middle = volume.grid.indexAt(centre);
        const std::array<int, 3> at{middle.i, middle.j, middle.k};
        for (std::size_t a = 0; a < 3; ++a) {
            const int reach = int((radius_mm + margin_mm) / volume.grid.spacing_mm[a]) + 2;
            from_[a] = std::max(0, at[a] - reach);
            size_[a] = std::max(0, std::min(volume.grid.size[a] - 1, at[a] + reach) - from_[a] + 1);
        }
        lumen_.resize(std::size_t(size_[0]) * std::size_t(size_[1]) * std::size_t(size_[2]));
        forEach([&](Index3 v, std::size_t n) {
            const Index3 there = inside.grid.indexAt(volume.grid.pointAt(v));
            lumen_[n] = inside.valueOr(there, std::uint8_t(kOutside)) != kOutside ? 1 : 0;
        });
        beyond_.resize(lumen_.size());
    }

    /// What lies below the wall and is lighter than soft tissue, and all behind it, is not the finding's.
    void endBehind(const CircledWall& wall, double margin_mm)
    {
        const double step_mm = std::cbrt(volume_->grid.voxelVolume_mm3()) / 2;
        // A voxel more than the margin: at its edge a blurred border with gas is as light as fat.
        beside_lumen_ = nearLumen(margin_mm + 3 * step_mm);
        forEach([&](Index3 v, std::size_t n) {
            const Point3 p = volume_->grid.pointAt(v);
            const double below_mm = dot(p - wall.surface_mm, wall.inwards) - wall.raised_mm;
            // As far behind the voxel as the margin reaches; from there up to the wall.
            if (below_mm <= 0)
                return;
            for (double up = -margin_mm; up <= below_mm && !beyond_[n]; up += step_mm)
                beyond_[n] = isLight(volume_->grid.indexAt(p - wall.inwards * up)) ? 1 : 0;
        });
    }

    /// Of the ball's tissue, where no voxel of lumen has its middle within `margin_mm`.
    std::vector<int> densities(double margin_mm) const
    {
        const std::vector<std::uint8_t> near = nearLumen(margin_mm);
        std::vector<int> taken;
        forEach([&](Index3 v, std::size_t n) {
            const int density = volume_->at(v);
            if (!near[n] && !beyond_[n] && density != kPaddingHu &&
                distance(volume_->grid.pointAt(v), centre_) <= radius_mm_)
                taken.push_back(density);
        });
        return taken;
    }

private:
    /// The lumen, and what has a voxel of it within `margin_mm`.
    std::vector<std::uint8_t> nearLumen(double margin_mm) const
    {
        std::vector<std::uint8_t> near(lumen_);
        const auto ball = ballOf(margin_mm);
        forEach([&](Index3 v, std::size_t n) {
            if (lumen_[n] && bordersTissue(v))
                for (const Index3& d : ball)
                    if (const Index3 beside{v.i + d.i, v.j + d.j, v.k + d.k}; holds(beside))
                        near[offset(beside)] = 1;
        });
        return near;
    }
    template <class Do>
    void forEach(Do what) const
    {
        std::size_t n = 0;
        for (int k = 0; k < size_[2]; ++k) {
            if (wanted_)
                wanted_->check();
            for (int j = 0; j < size_[1]; ++j)
                for (int i = 0; i < size_[0]; ++i, ++n)
                    what(Index3{from_[0] + i, from_[1] + j, from_[2] + k}, n);
        }
    }
    /// Of 27 voxels the mean: noise alone makes no fat. Those beside the lumen, half gas, are not counted.
    bool isLight(Index3 middle) const
    {
        double sum = 0;
        int count = 0;
        for (int n = 0; n < 27; ++n) {
            const Index3 v{middle.i + n % 3 - 1, middle.j + n / 3 % 3 - 1, middle.k + n / 9 - 1};
            if (!volume_->grid.contains(v) || (holds(v) && beside_lumen_[offset(v)]))
                continue;
            sum += volume_->at(v);
            ++count;
        }
        return count > 0 && sum / count < kFatTo_hu;
    }
    bool holds(Index3 v) const
    {
        const int i = v.i - from_[0], j = v.j - from_[1], k = v.k - from_[2];
        return i >= 0 && j >= 0 && k >= 0 && i < size_[0] && j < size_[1] && k < size_[2];
    }
    std::size_t offset(Index3 v) const
    {
        return std::size_t(v.i - from_[0]) +
               std::size_t(size_[0]) *
                   (std::size_t(v.j - from_[1]) + std::size_t(size_[1]) * std::size_t(v.k - from_[2]));
    }
    bool bordersTissue(Index3 v) const
    {
        for (const Index3 beside : {Index3{v.i + 1, v.j, v.k}, Index3{v.i - 1, v.j, v.k}, Index3{v.i, v.j + 1, v.k},
                                    Index3{v.i, v.j - 1, v.k}, Index3{v.i, v.j, v.k + 1}, Index3{v.i, v.j, v.k - 1}})
            if (holds(beside) && !lumen_[offset(beside)])
                return true;
        return false;
    }
    std::vector<Index3> ballOf(double radius_mm) const
    {
        const auto& spacing = volume_->grid.spacing_mm;
        std::array<int, 3> reach{};
        for (std::size_t a = 0; a < 3; ++a)
            reach[a] = int(radius_mm / spacing[a]);
        std::vector<Index3> ball;
        for (int k = -reach[2]; k <= reach[2]; ++k)
            for (int j = -reach[1]; j <= reach[1]; ++j)
                for (int i = -reach[0]; i <= reach[0]; ++i)
                    if (std::hypot(i * spacing[0], j * spacing[1], k * spacing[2]) < radius_mm)
                        ball.push_back({i, j, k});
        return ball;
    }

    const HuView* volume_;
    const Progress* wanted_;
    Point3 centre_;
    double radius_mm_;
    std::array<int, 3> from_{}, size_{};
    std::vector<std::uint8_t> lumen_, beside_lumen_, beyond_;
};

int binOf(int density_hu)
{
    return int(std::floor(double(density_hu) / DensitySample::kBin_hu));
}

void describe(DensitySample& sample, const std::vector<int>& densities)
{
    sample.voxels = densities.size();
    const auto [lowest, highest] = std::minmax_element(densities.begin(), densities.end());
    sample.from_hu = binOf(*lowest) * DensitySample::kBin_hu;
    sample.counts.assign(std::size_t(binOf(*highest) - binOf(*lowest)) + 1, 0);
    double sum = 0, squares = 0, fat = 0;
    for (const int hu : densities) {
        ++sample.counts[std::size_t(binOf(hu) - binOf(*lowest))];
        sum += hu;
        squares += double(hu) * hu;
        fat += hu >= kFatFrom_hu && hu <= kFatTo_hu ? 1 : 0;
    }
    const auto n = double(densities.size());
    sample.mean_hu = sum / n;
    sample.sd_hu = std::sqrt(std::max(0.0, squares / n - sample.mean_hu * sample.mean_hu));
    sample.fat_fraction = fat / n;
}

}  // namespace

DensitySample sampleDensity(const HuView& volume, const InsideView& inside, Point3 centre, double radius_mm,
                            const std::optional<CircledWall>& wall, const Progress* wanted)
{
    if (!(radius_mm >= kLeastRadius_mm && radius_mm <= kMostRadius_mm))
        throw Error(ErrorCode::wrong_use, "the radius of a density sample is 0.5 to 25 mm", std::to_string(radius_mm));
    const double voxel_mm = std::cbrt(volume.grid.voxelVolume_mm3()), least_mm = kMarginVoxels * voxel_mm;
    Surroundings around(volume, inside, centre, radius_mm, std::max(kMargin_mm, least_mm) + voxel_mm, wanted);
    if (wall)
        around.endBehind(*wall, least_mm);
    DensitySample sample{centre, radius_mm};
    for (const double margin_mm : {std::max(kMargin_mm, least_mm), least_mm}) {
        // The lumen's border lies half a voxel outside the middles of its outermost voxels.
        const auto densities = around.densities(margin_mm + voxel_mm / 2);
        if (densities.size() < DensitySample::kLeastVoxels) {
            if (wall && wall->raised_mm <= kMargin_mm)
                break;  // no small finding, but a thin wall
            continue;
        }
        sample.margin_mm = margin_mm;
        describe(sample, densities);
        break;
    }
    return sample;
}

}  // namespace vicon

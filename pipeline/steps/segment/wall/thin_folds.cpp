#include "segment/wall/thin_folds.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

#include "grid/lattice.h"
#include "grid/neighbours.h"
#include "segment/wall/trim_lumen.h"

namespace vicon::steps {
namespace {

// All chosen on ctc-prone and on the default phantom's seeds 301, 303 and 310 (low dose).

/// How far from a fold's middle its blur may reach: half of a fold of 3 mm and the edge of a soft kernel.
constexpr double kReach_mm = 4;
/// Part of the contrast between tissue and fluid: how dark the bottom of a fold must be.
constexpr double kDark = 0.3;
/// In a pool whose contrast is less than this many times its noise, valleys are noise.
constexpr double kLeastContrast_noises = 7;
/// Gas this near may be a wedge or bubble thinner than the blur, which makes valleys of its own.
constexpr int kGas_voxels = 3;

/// The thirteen lines through a voxel and its neighbours.
constexpr int kLines[13][3] = {{1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {1, 1, 0},  {1, -1, 0}, {1, 0, 1}, {1, 0, -1},
                               {0, 1, 1}, {0, 1, -1}, {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};

class Folds {
public:
    Folds(const HuVolume& volume, Index3 offset, double tissue_hu)
        : volume_(volume),
          offset_(offset),
          row_(volume.grid.size[0]),
          slice_(row_ * volume.grid.size[1]),
          margin_(std::max(int(kReach_mm / volume.grid.spacing_mm[0]), WallField::kFoldBottom_voxels + 1)),
          tissue_hu_(tissue_hu)
    {
    }

    /// Never near to the scan's end.
    bool hold(Index3 v, double fluid_hu) const
    {
        const Index3 w{v.i + offset_.i, v.j + offset_.j, v.k + offset_.k};
        const auto [nx, ny, nz] = volume_.grid.size;
        const double contrast = fluid_hu - tissue_hu_;
        if (std::min({w.i, w.j, w.k}) < margin_ || w.i >= nx - margin_ || w.j >= ny - margin_ || w.k >= nz - margin_)
            return false;
        const std::int16_t* at = &volume_.voxels[volume_.grid.offset(w)];
        // The slopes of a fold are dark by half as much as its bottom.
        if (*at > fluid_hu - kDark / 2 * contrast)
            return false;
        const double here = smooth(at);
        if (here > fluid_hu - kDark / 2 * contrast || !isValley(at, (here + fluid_hu) / 2))
            return false;
        const double bottom = bottomNear(at);
        return bottom < fluid_hu - kDark * contrast && here < (bottom + fluid_hu) / 2;
    }

private:
    /// The binomial mean over 3 x 3 x 3 voxels: noise alone makes no valleys in it.
    double smooth(const std::int16_t* at) const
    {
        const auto alongRow = [](const std::int16_t* v) { return v[-1] + 2 * v[0] + v[1]; };
        const auto inSlice = [&](const std::int16_t* v) {
            return alongRow(v - row_) + 2 * alongRow(v) + alongRow(v + row_);
        };
        return (inSlice(at - slice_) + 2 * inSlice(at) + inSlice(at + slice_)) / 64.0;
    }

    /// Whether densities of at least `bright_hu` lie on both sides along any line.
    bool isValley(const std::int16_t* at, double bright_hu) const
    {
        return std::any_of(std::begin(kLines), std::end(kLines), [&](const int* line) {
            const int axes = std::abs(line[0]) + std::abs(line[1]) + std::abs(line[2]);
            const int steps = std::max(1, int(kReach_mm / (std::sqrt(axes) * volume_.grid.spacing_mm[0])));
            const std::ptrdiff_t step = line[0] + line[1] * row_ + line[2] * slice_;
            const auto bright = [&](std::ptrdiff_t by) {
                for (int n = 1; n <= steps; ++n)
                    if (at[n * by] >= bright_hu)
                        return true;
                return false;
            };
            return bright(step) && bright(-step);
        });
    }

    double bottomNear(const std::int16_t* at) const
    {
        double bottom = *at;
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i)
                    bottom = std::min(bottom, smooth(at + WallField::kFoldBottom_voxels * (i + j * row_ + k * slice_)));
        return std::max(bottom, tissue_hu_);
    }

    const HuVolume& volume_;
    Index3 offset_;
    std::ptrdiff_t row_, slice_;
    int margin_;  ///< voxels, as far as any density is asked for
    double tissue_hu_;
};

bool besideGas(const InsideVolume& inside, Index3 v)
{
    return anyInCube(v, kGas_voxels, [&](Index3 n) { return inside.valueOr(n, kOutside) == kGas; });
}

/// Those that hang together with the wall over faces, edges or corners.
std::vector<std::size_t> onTheWall(const std::vector<std::size_t>& found, const InsideVolume& inside)
{
    const auto around = [&](std::size_t n, auto visit) { forEachInCube(inside.grid.indexOf(n), 1, visit); };
    std::vector<std::uint8_t> reached(found.size(), 0);
    std::vector<std::size_t> front, kept;
    for (std::size_t n = 0; n < found.size(); ++n) {
        around(found[n], [&](Index3 w) { reached[n] |= inside.valueOr(w, kOutside) == kOutside ? 1 : 0; });
        if (reached[n])
            front.push_back(n);
    }
    while (!front.empty()) {
        const std::size_t n = front.back();
        front.pop_back();
        kept.push_back(found[n]);
        around(found[n], [&](Index3 w) {
            if (!inside.grid.contains(w))
                return;
            const auto at = std::lower_bound(found.begin(), found.end(), inside.grid.offset(w));
            if (at == found.end() || *at != inside.grid.offset(w) || reached[std::size_t(at - found.begin())])
                return;
            reached[std::size_t(at - found.begin())] = 1;
            front.push_back(std::size_t(at - found.begin()));
        });
    }
    return kept;
}

std::vector<std::size_t> foldsIn(const WallField& wall, double tissue_hu, const Folds& folds,
                                 const InsideVolume& inside)
{
    const std::vector<Run>& runs = wall.fluidRuns();
    using Offsets = std::vector<std::size_t>;
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, runs.size(), 1 << 12), Offsets{},
        [&](const tbb::blocked_range<std::size_t>& range, Offsets found) {
            for (std::size_t n = range.begin(); n < range.end(); ++n) {
                const double fluid_hu = wall.poolDensity(runs[n]);
                if (fluid_hu - tissue_hu < kLeastContrast_noises * wall.poolNoise(runs[n]))
                    continue;
                for (Index3 v{runs[n].begin, runs[n].j, runs[n].k}; v.i < runs[n].end; ++v.i)
                    if (folds.hold(v, fluid_hu) && !besideGas(inside, v))
                        found.push_back(inside.grid.offset(v));
            }
            return found;
        },
        [](Offsets a, const Offsets& b) {
            a.insert(a.end(), b.begin(), b.end());
            return a;
        });
}

}  // namespace

void keepThinFolds(const HuVolume& volume, const WallDensities& densities, int pieces, InsideVolume& inside)
{
    const WallField wall(volume, inside, densities);
    const Folds of_blur(volume, latticeOffset(inside.grid, volume.grid), densities.tissue_hu);
    const std::vector<std::size_t> folds = onTheWall(foldsIn(wall, densities.tissue_hu, of_blur, inside), inside);
    for (const std::size_t n : folds)
        inside.voxels[n] = kOutside;
    trimLumen(folds, pieces, inside);
}

}  // namespace vicon::steps

#include "tissue/mottled.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/along_axis.h"
#include "tissue/enclosed.h"

namespace vicon::steps {
namespace {

// Chosen on ctc-prone (noise 28 HU): of its blocks 99 in 100 deviate by less than 79 HU, those of the sediment in its
// caecum by 109 HU and more. Held by MottledTagging.
constexpr double kBlock_mm = 4;
constexpr int kEdge_voxels = 2;  // two sigma of the point spread: nearer to its edge fluid has no density of its own
constexpr double kLeastShare = 0.3;       // of a block's voxels
constexpr double kLeastEnclosed = 0.1;    // the same, of what is no fluid and lies in it: bubbles and untagged grains
constexpr double kNoisesOfMottled = 3;    // dense fluid and streaks have more noise than tissue
constexpr double kShareOfDensity = 0.15;  // beam hardening and sediment of even grain stay below

/// Blocks of voxels over the labels' grid.
struct Blocks {
    explicit Blocks(const Grid& of) : grid(of)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = std::size_t(axis);
            voxels[a] = std::max(1, int(std::lround(kBlock_mm / of.spacing_mm[a])));
            count[a] = (of.size[a] + voxels[a] - 1) / voxels[a];
        }
    }
    std::size_t all() const { return std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]); }
    std::size_t number(Index3 b) const
    {
        return (std::size_t(b.k) * std::size_t(count[1]) + std::size_t(b.j)) * std::size_t(count[0]) + std::size_t(b.i);
    }
    bool contains(Index3 b) const
    {
        return b.i >= 0 && b.j >= 0 && b.k >= 0 && b.i < count[0] && b.j < count[1] && b.k < count[2];
    }
    std::size_t numberAt(Index3 v) const { return number({v.i / voxels[0], v.j / voxels[1], v.k / voxels[2]}); }
    Index3 first(Index3 b) const { return {b.i * voxels[0], b.j * voxels[1], b.k * voxels[2]}; }
    Point3 middle_mm(Index3 b) const
    {
        const Index3 v = first(b);
        return grid.pointAt(
            ContinuousIndex3{v.i + (voxels[0] - 1) / 2.0, v.j + (voxels[1] - 1) / 2.0, v.k + (voxels[2] - 1) / 2.0});
    }
    template <class Visit>
    void each(Visit visit) const
    {
        for (int k = 0; k < count[2]; ++k)
            for (int j = 0; j < count[1]; ++j)
                for (int i = 0; i < count[0]; ++i)
                    visit(Index3{i, j, k});
    }

    Grid grid;
    std::array<int, 3> voxels{}, count{};
};

bool awayFromEdges(const InsideVolume& labels, Index3 v)
{
    if (labels.at(v) != kFluid)
        return false;
    for (int axis = 0; axis < 3; ++axis)
        for (const int steps : {-kEdge_voxels, kEdge_voxels})
            if (labels.valueOr(beside(v, axis, steps), kOutside) != kFluid)
                return false;
    return true;
}

/// The densities of a block's voxels.
class Spread {
public:
    void add(double hu)
    {
        ++count_;
        sum_ += hu;
        squares_ += hu * hu;
    }
    double count() const { return count_; }
    /// Whether they differ by more than noise and beam hardening do.
    bool isMottled(double noise_hu) const
    {
        const double mean_hu = sum_ / count_, variance = squares_ / count_ - mean_hu * mean_hu;
        return std::sqrt(std::max(0.0, variance)) > std::max(kNoisesOfMottled * noise_hu, kShareOfDensity * mean_hu);
    }

private:
    double count_ = 0, sum_ = 0, squares_ = 0;
};

/// Calls use(Index3) for a block's voxels.
template <class Use>
void forEachIn(const Blocks& blocks, Index3 block, Use use)
{
    const Index3 first = blocks.first(block);
    const auto end = [&](int from, std::size_t axis) {
        return std::min(from + blocks.voxels[axis], blocks.grid.size[axis]);
    };
    for (int k = first.k; k < end(first.k, 2); ++k)
        for (int j = first.j; j < end(first.j, 1); ++j)
            for (int i = first.i; i < end(first.i, 0); ++i)
                use(Index3{i, j, k});
}

bool isMottled(const Mixture& mixture, const Blocks& blocks, Index3 block, double noise_hu)
{
    const InsideVolume& labels = mixture.inside;
    const double all = blocks.voxels[0] * blocks.voxels[1] * blocks.voxels[2];
    double fluid = 0;
    forEachIn(blocks, block, [&](Index3 v) { fluid += labels.at(v) == kFluid ? 1 : 0; });
    if (fluid < kLeastShare * all)
        return false;
    Spread pure, with_enclosed;
    double enclosed = 0;
    const auto isFluid = [&](Index3 v) { return labels.valueOr(v, kOutside) == kFluid; };
    forEachIn(blocks, block, [&](Index3 v) {
        const std::uint8_t label = labels.at(v);
        if (label == kFluid && awayFromEdges(labels, v))
            pure.add(mixture.hu(v));
        const bool is_enclosed = label == kOutside && isEnclosed(v, isFluid);
        if (label == kFluid || is_enclosed)
            with_enclosed.add(mixture.hu(v));
        enclosed += is_enclosed ? 1 : 0;
    });
    return (pure.count() >= kLeastShare * all && pure.isMottled(noise_hu)) ||
           (enclosed >= kLeastEnclosed * all && with_enclosed.isMottled(noise_hu));
}

bool standsAlone(const Blocks& blocks, const std::vector<std::uint8_t>& mottled, Index3 b)
{
    for (int k = b.k - 1; k <= b.k + 1; ++k)
        for (int j = b.j - 1; j <= b.j + 1; ++j)
            for (int i = b.i - 1; i <= b.i + 1; ++i)
                if (const Index3 other{i, j, k};
                    !(other == b) && blocks.contains(other) && mottled[blocks.number(other)])
                    return false;
    return true;
}

/// The part of each block that stool takes; where it mixes with gas, half.
std::vector<float> stoolShares(const Blocks& blocks, const Stool& stool)
{
    std::vector<float> shares(blocks.all(), 0);
    const float voxel = 1 / float(blocks.voxels[0] * blocks.voxels[1] * blocks.voxels[2]);
    const auto add = [&](const std::vector<std::size_t>& voxels, float part) {
        for (const std::size_t n : voxels)
            shares[blocks.numberAt(blocks.grid.indexOf(n))] += part * voxel;
    };
    add(stool.dense, 1);
    add(stool.left, 1);
    add(stool.mixed, 0.5F);
    return shares;
}

}  // namespace

MottledTagging findMottled(const Mixture& mixture, const Stool& stool, double noise_hu)
{
    const Blocks blocks(mixture.inside.grid);
    std::vector<std::uint8_t> mottled(blocks.all(), 0);
    tbb::parallel_for(0, blocks.count[2], [&](int k) {
        for (int j = 0; j < blocks.count[1]; ++j)
            for (int i = 0; i < blocks.count[0]; ++i)
                mottled[blocks.number({i, j, k})] = isMottled(mixture, blocks, {i, j, k}, noise_hu) ? 1 : 0;
    });
    double volume_mm3 = 1;
    for (std::size_t a = 0; a < 3; ++a)
        volume_mm3 *= blocks.voxels[a] * mixture.inside.grid.spacing_mm[a];
    MottledTagging found{.block_mm = std::cbrt(volume_mm3), .blocks_mm = {}, .shares = {}};
    const std::vector<float> stool_shares = stoolShares(blocks, stool);
    blocks.each([&](Index3 b) {
        const std::size_t n = blocks.number(b);
        const bool is_mottled = mottled[n] && !standsAlone(blocks, mottled, b);
        if (is_mottled || stool_shares[n] > 0)
            found.add(blocks.middle_mm(b), is_mottled ? 1 : std::min(1.0, double(stool_shares[n])));
    });
    return found;
}

}  // namespace vicon::steps

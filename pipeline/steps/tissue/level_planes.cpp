#include "tissue/level_planes.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace vicon::steps {
namespace {

// Held by tissue_test: levels against walls at 30 to 150 degrees.

/// How far around a column the others' planes are asked for, in voxels, and the width of their weight.
constexpr int kAround_voxels = 4;
constexpr double kWidth_voxels = 2;
/// At this fraction of tissue a column tells nothing.
constexpr double kImpureTissue = 0.2;
/// The planes around a column must weigh as much as one pure column a width away.
constexpr double kEnough = 0.6;
/// A plane is handed on so far, column by column: as far as levels go on into the wall.
constexpr int kHandedOn = 16;

class Planes {
public:
    Planes(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels, const LevelVoxels& voxels,
           const TissueVolume& tissue)
        : mixture_(mixture), down_(down), voxels_(voxels), tissue_(tissue), columns_(levels.columns)
    {
    }

    std::vector<float> settled() const
    {
        std::vector<Plane> own(columns_.size()), found(columns_.size());
        forAll([&](std::size_t n) { own[n] = ownOf(columns_[n]); });
        forAll([&](std::size_t n) {
            found[n] = meanAround(n, own, kAround_voxels);
            if (found[n].weight < kEnough)
                found[n] = {};
        });
        for (int round = 0; round < kHandedOn; ++round) {
            std::vector<Plane> next = found;
            forAll([&](std::size_t n) {
                if (found[n].weight == 0)
                    next[n] = meanAround(n, found, 1);
            });
            found = std::move(next);
        }
        std::vector<float> depths(columns_.size());
        forAll([&](std::size_t n) { depths[n] = found[n].weight > 0 ? float(found[n].depth) : columns_[n].depth; });
        return depths;
    }

private:
    struct Plane {
        double depth = 0, weight = 0;
    };

    template <class Use>
    void forAll(Use use) const
    {
        tbb::parallel_for(std::size_t(0), columns_.size(), use);
    }

    Plane ownOf(const LevelColumn& column) const
    {
        const auto crossing = crossingNear(mixture_, down_, column.at, 2);
        if (!crossing)
            return {};
        const int at = int(std::floor((*crossing - down_.depth(column.at)) / down_.upright));
        double pure = 1;
        for (int n = at - 1; n <= at + 2; ++n)
            pure *= std::max(0.0, 1 - tissue_.valueOr(down_.moved(column.at, n), kAllTissue) / kWhole / kImpureTissue);
        return {planeOf(*crossing, column, mixture_), pure};
    }

    /// Of a column and those around it of the same level.
    Plane meanAround(std::size_t n, const std::vector<Plane>& planes, int reach) const
    {
        const LevelColumn& column = columns_[n];
        double depth = 0, weight = 0;
        for (int a = -reach; a <= reach; ++a)
            for (int b = -reach; b <= reach; ++b) {
                const Index3 v = beside(beside(column.at, (down_.axis + 1) % 3, a), (down_.axis + 2) % 3, b);
                if (!tissue_.grid.contains(v))
                    continue;
                if (const auto other = columnAt(v)) {
                    const double share =
                        planes[*other].weight * std::exp(-0.5 * (a * a + b * b) / (kWidth_voxels * kWidth_voxels));
                    depth += share * planes[*other].depth;
                    weight += share;
                }
            }
        return weight > 0 ? Plane{depth / weight, weight} : Plane{};
    }

    /// The column of a level whose plane passes beside a voxel, at most a voxel higher or lower.
    std::optional<std::size_t> columnAt(Index3 v) const
    {
        std::optional<std::size_t> found;
        voxels_.forColumn(v, [&](const LevelVoxel& voxel) {
            if (std::abs(down_.along(columns_[voxel.column].at) - down_.along(v)) <= 1)
                found = voxel.column;
        });
        return found;
    }

    static constexpr std::uint8_t kAllTissue = 255;  // a definition
    const Mixture& mixture_;
    const DownAxis& down_;
    const LevelVoxels& voxels_;
    const TissueVolume& tissue_;
    const std::vector<LevelColumn>& columns_;
};

}  // namespace

std::vector<float> settledPlanes(const Mixture& mixture, const DownAxis& down, const FluidLevels& levels,
                                 const LevelVoxels& voxels, const TissueVolume& tissue)
{
    return Planes(mixture, down, levels, voxels, tissue).settled();
}

}  // namespace vicon::steps

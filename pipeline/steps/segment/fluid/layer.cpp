#include "segment/fluid/layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <unordered_map>

#include "grid/along_axis.h"
#include "segment/constants.h"

namespace vicon::steps {
namespace {

// Held by chain_family_test and segment_test. Half and double of each move the wall of ctc-prone by less than
// 0.002 mm in the mean and that of phantom 215 by 0.0002 mm or less.

// The widest point spread that is reckoned with; two sigma of it from the level gas and fluid have their own densities.
constexpr double kWidestBlur_mm = 0.8;
constexpr double kHalfLayer_mm = 2 * kWidestBlur_mm;
// How far the wall beside a level may reach into the layer's columns; the shape is sought as far.
constexpr int kBeside_voxels = 3;
// Where a level's own blur is this far from tissue, a voxel nearer to tissue than to it is wall: half of it is two
// standard deviations of a low-dose scan's noise.
constexpr double kTelling_hu = 300;

/// A column through a level: the voxel that holds the level, and the level's place below that voxel's middle.
struct Column {
    Index3 at;
    double level_voxels = 0;  ///< along `down`, from -0.5 to 0.5
    int away2 = 0;            ///< squared distance to the contact that it stands beside, in voxels
};

class Layer {
public:
    Layer(const HuVolume& volume, Down down, double tissue_hu, InsideVolume& labels)
        : volume_(volume),
          down_(down),
          tissue_hu_(tissue_hu),
          labels_(labels),
          side_{(down.axis + 1) % 3, (down.axis + 2) % 3},
          half_(std::max(1, int(std::lround(kHalfLayer_mm / labels.grid.spacing_mm[std::size_t(down.axis)]))))
    {
        const Grid& grid = labels.grid;
        const auto along_gravity = [&](int axis) {
            return dot(grid.axis[std::size_t(axis)], down.gravity) * grid.spacing_mm[std::size_t(axis)];
        };
        for (std::size_t n = 0; n < 2; ++n)
            slope_[n] = -along_gravity(side_[n]) / (along_gravity(down.axis) * down.sign);
    }

    void close(const ContactPatch& patch)
    {
        fillContacts(patch);
        std::vector<Index3> found;
        for (const Column& column : columnsBeside(patch))
            shape(column, patch.density_hu, found);
        for (const Index3 v : found)
            fill(v, patch.density_hu);
    }

private:
    void fill(Index3 v, double density_hu)
    {
        if (std::uint8_t& label = labels_.at(v); !label)
            label = volume_.at(v) < (density_hu + kAir_hu) / 2 ? kGas : kFluid;
    }

    Index3 below(Index3 v, int steps) const { return beside(v, down_.axis, down_.sign * steps); }

    void fillContacts(const ContactPatch& patch)
    {
        for (const Contact& contact : patch.contacts)
            for (int n = 1; n < contact.steps; ++n)
                fill(below(contact.gas, n), contact.density_hu);
    }

    /// The columns within kBeside_voxels of the contacts, each with the level of the nearest one.
    std::vector<Column> columnsBeside(const ContactPatch& patch) const
    {
        std::vector<Column> columns;
        std::unordered_map<std::size_t, std::size_t> number;
        for (const Contact& contact : patch.contacts)
            for (int b = -kBeside_voxels; b <= kBeside_voxels; ++b)
                for (int a = -kBeside_voxels; a <= kBeside_voxels; ++a) {
                    const double level = contact.below_voxels + slope_[0] * a + slope_[1] * b;
                    const int whole = int(std::lround(level));
                    Column column{below(contact.gas, whole), level - whole, a * a + b * b};
                    coordinate(column.at, side_[0]) += a;
                    coordinate(column.at, side_[1]) += b;
                    Index3 foot = column.at;
                    coordinate(foot, down_.axis) = 0;
                    if (!labels_.grid.contains(foot) || !labels_.grid.contains(column.at))
                        continue;
                    const auto [entry, is_new] = number.try_emplace(labels_.grid.offset(foot), columns.size());
                    if (is_new)
                        columns.push_back(column);
                    else if (column.away2 < columns[entry->second].away2)
                        columns[entry->second] = column;
                }
        return columns;
    }

    /// Signed distance across gravity to the lumen's edge, in voxels, negative inside; sought kBeside_voxels around.
    double edgeDistance(Index3 v) const
    {
        const bool inside = labels_.valueOr(v, kOutside) != kOutside;
        int nearest2 = 2 * (kBeside_voxels + 1) * (kBeside_voxels + 1);
        for (int b = -kBeside_voxels; b <= kBeside_voxels; ++b)
            for (int a = -kBeside_voxels; a <= kBeside_voxels; ++a) {
                Index3 n = v;
                coordinate(n, side_[0]) += a;
                coordinate(n, side_[1]) += b;
                if (a * a + b * b < nearest2 && (labels_.valueOr(n, kOutside) != kOutside) != inside)
                    nearest2 = a * a + b * b;
            }
        const double away = std::sqrt(double(nearest2)) - 0.5;
        return inside ? -away : away;
    }

    enum class Tells : std::uint8_t { nothing, wall, lumen };

    /// What the density of a voxel so far below the level tells: nearer to tissue than to what the level's blur makes
    /// of gas and fluid there is wall, a thin fold that stands in the layer or runs along it.
    Tells density(Index3 v, double below_voxels, double fluid_hu) const
    {
        const double sigmas = below_voxels * labels_.grid.spacing_mm[std::size_t(down_.axis)] / kWidestBlur_mm;
        const double level_hu = std::lerp(kAir_hu, fluid_hu, (1 + std::erf(sigmas / std::sqrt(2))) / 2);
        const double contrast = level_hu - tissue_hu_;
        if (std::abs(contrast) <= kTelling_hu)
            return Tells::nothing;
        return (volume_.at(v) - tissue_hu_) / contrast < 0.5 ? Tells::wall : Tells::lumen;
    }

    /// The voxels of a column's layer that lie inside the shape between its two ends and are not plainly wall, nor
    /// between what is.
    void shape(const Column& column, double fluid_hu, std::vector<Index3>& found) const
    {
        bool open = false;
        for (int n = -half_; n <= half_; ++n)
            open = open || labels_.valueOr(below(column.at, n), kGas) == kOutside;
        if (!open)
            return;
        const double top = edgeDistance(below(column.at, -half_ - 1)),
                     bottom = edgeDistance(below(column.at, half_ + 1));
        std::vector<Tells> told{top < 0 ? Tells::lumen : Tells::wall};
        for (int n = -half_; n <= half_; ++n) {
            const Index3 v = below(column.at, n);
            const double part = (n - column.level_voxels + half_ + 1) / (2.0 * half_ + 2);
            if (labels_.valueOr(v, kGas) != kOutside)
                told.push_back(Tells::lumen);
            else if (std::lerp(top, bottom, part) >= 0)
                told.push_back(Tells::wall);
            else
                told.push_back(density(v, n - column.level_voxels, fluid_hu));
        }
        told.push_back(bottom < 0 ? Tells::lumen : Tells::wall);
        const auto tells = [](Tells t) { return t != Tells::nothing; };
        for (auto here = told.begin() + 1; here + 1 != told.end(); ++here) {
            const Index3 v = below(column.at, int(here - told.begin()) - 1 - half_);
            const bool in_lumen = *std::find_if(here, told.end(), tells) == Tells::lumen ||
                                  *std::find_if(std::reverse_iterator(here + 1), told.rend(), tells) == Tells::lumen;
            if (in_lumen && labels_.valueOr(v, kGas) == kOutside)
                found.push_back(v);
        }
    }

    const HuVolume& volume_;
    Down down_;
    double tissue_hu_;
    InsideVolume& labels_;
    std::array<int, 2> side_;
    std::array<double, 2> slope_{};  ///< how much lower a level lies one voxel further along a side axis
    int half_;
};

}  // namespace

void closeFluidLayer(const HuVolume& volume, Down down, const std::vector<ContactPatch>& patches, double tissue_hu,
                     InsideVolume& labels)
{
    Layer layer(volume, down, tissue_hu, labels);
    for (const ContactPatch& patch : patches)
        layer.close(patch);
}

}  // namespace vicon::steps

#include "segment/fluid/runaway.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "grid/along_axis.h"
#include "grid/neighbours.h"
#include "grid/run_labels.h"
#include "segment/constants.h"

namespace vicon::steps {
namespace {

// Chosen on the second phantom's seed 133 (rough), whose spine touches two pools; nothing else that was seen floods
// out.
/// From a level along the flood.
constexpr double kFarthest_mm = 40;
/// A pool's density changes by less over that way.
constexpr double kOwnDensity_hu = 80;
/// Blur at the flood's edge.
constexpr int kRim_voxels = 2;

class Runaways {
public:
    Runaways(const HuVolume& volume, Down down, InsideVolume& labels) : volume_(volume), down_(down), labels_(labels) {}

    double cut(const std::vector<ContactPatch>& patches)
    {
        if (!fluidAtAnEnd())
            return 0;
        fluid_ = labelRuns(labels_.grid.size, scanner(), Neighbours::faces);
        const std::set<int> away = thoseThatLeave();
        if (away.empty())
            return 0;
        InsideVolume kept(labels_.grid, kOutside);
        for (const ContactPatch& patch : patches)
            keepOwn(patch, away, kept);
        const auto before = std::ranges::count(labels_.voxels, std::uint8_t(kFluid));
        fluid_.forEachRun([&](const VoxelRun& run, int j, int k) {
            for (int i = run.begin; i < run.end; ++i)
                if (away.contains(int(run.label)) &&
                    !anyInCube({i, j, k}, kRim_voxels, [&](Index3 v) { return kept.valueOr(v, kOutside) != kOutside; }))
                    labels_.at({i, j, k}) = kOutside;
        });
        const auto taken = before - std::ranges::count(labels_.voxels, std::uint8_t(kFluid));
        return double(taken) * labels_.grid.voxelVolume_mm3() / 1000;
    }

private:
    RowScanner scanner() const
    {
        return [this](int j, int k, std::vector<VoxelRun>& runs) {
            const std::size_t first = runs.size();
            for (int i = 0; i < labels_.grid.size[0]; ++i)
                if (labels_.at({i, j, k}) == kFluid) {
                    if (runs.size() == first || runs.back().end != i)
                        runs.push_back({.begin = i, .end = i});
                    runs.back().end = i + 1;
                }
        };
    }

    bool fluidAtAnEnd() const
    {
        const auto slice = std::ptrdiff_t(labels_.grid.size[0]) * labels_.grid.size[1];
        const double face_mm2 = labels_.grid.spacing_mm[0] * labels_.grid.spacing_mm[1];
        const auto isLarge = [&](auto first) {
            return double(std::count(first, first + slice, std::uint8_t(kFluid))) * face_mm2 > kLargestCut_mm2;
        };
        return isLarge(labels_.voxels.begin()) || isLarge(labels_.voxels.end() - slice);
    }

    /// Components that meet the scan's first or last slice over a large area.
    std::set<int> thoseThatLeave() const
    {
        std::set<int> away;
        const double face_mm2 = labels_.grid.spacing_mm[0] * labels_.grid.spacing_mm[1];
        for (const int k : {0, labels_.grid.size[2] - 1}) {
            std::vector<double> area_mm2(fluid_.components.size(), 0);
            for (int j = 0; j < labels_.grid.size[1]; ++j)
                for (std::size_t r = fluid_.row_begin[fluid_.row(j, k)]; r < fluid_.row_begin[fluid_.row(j, k) + 1];
                     ++r)
                    area_mm2[fluid_.runs[r].label] += face_mm2 * (fluid_.runs[r].end - fluid_.runs[r].begin);
            for (std::size_t n = 0; n < area_mm2.size(); ++n)
                if (area_mm2[n] > kLargestCut_mm2)
                    away.insert(int(n));
        }
        return away;
    }

    bool isOwn(Index3 v, double density_hu) const
    {
        double sum = 0;
        int count = 0;
        forEachInCube(v, 1, [&](Index3 n) {
            if (volume_.grid.contains(n)) {
                sum += volume_.at(n);
                ++count;
            }
        });
        return std::abs(sum / count - density_hu) < kOwnDensity_hu;
    }

    void keepOwn(const ContactPatch& patch, const std::set<int>& away, InsideVolume& kept) const
    {
        std::vector<std::size_t> front, next;
        for (const Contact& contact : patch.contacts) {
            const Index3 v = beside(contact.gas, down_.axis, down_.sign * (contact.steps + kRim_voxels));
            if (labels_.grid.contains(v) && away.contains(fluid_.labelAt(v)))
                front.push_back(labels_.grid.offset(v));
        }
        const int steps = int(kFarthest_mm / labels_.grid.spacing_mm[0]);
        for (int n = 0; n < steps && !front.empty(); ++n, front.swap(next), next.clear())
            for (const std::size_t from : front)
                forEachOverFaces(labels_.grid, from, [&](std::size_t to) {
                    if (kept.voxels[to] || labels_.voxels[to] != kFluid ||
                        !isOwn(labels_.grid.indexOf(to), patch.density_hu))
                        return;
                    kept.voxels[to] = kFluid;
                    next.push_back(to);
                });
    }

    const HuVolume& volume_;
    Down down_;
    InsideVolume& labels_;
    RunLabels fluid_;
};

}  // namespace

double cutRunaways(const HuVolume& volume, Down down, const std::vector<ContactPatch>& patches, InsideVolume& labels)
{
    return Runaways(volume, down, labels).cut(patches);
}

}  // namespace vicon::steps

#include "vicon/viewer/model/wall_tagging.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "density_sampler.h"
#include "recorded_option.h"

namespace vicon::viewer {
namespace {

constexpr float kTagNoises = 3;     // a density between voxels has less noise than a voxel: five of its own
constexpr float kTagRise_hu = 100;  // from where tagging begins to where it is sure
// A film on a flat polyp is 1.5 mm thick in the mean (PMC3996850); farther in stands what does not touch the wall.
constexpr float kTagReach_mm = 2.5F, kTagStep_mm = 0.5F;
// Of a block's side. A block of mottled fluid keeps two voxels off the wall; one of stool holds the wall under it, also
// where air in the stool leaves no tagging before it.
constexpr double kBesideMottled = 1.75, kInMottled = 1;

/// The highest density on the way into the lumen, from the wall to where the lumen ends or is wide.
float highestBefore(Point3 point, Vector3 normal, const DensitySampler& densities, const InsideView& inside,
                    float tissue_hu)
{
    float highest = tissue_hu;
    bool entered = false;
    for (float away = 0; away <= kTagReach_mm; away += kTagStep_mm) {
        const Point3 at = point + normal * double(away);
        const bool is_inside = inside.valueOr(inside.grid.indexAt(at), 0) != 0;
        if (entered && !is_inside)
            break;
        entered = entered || is_inside;
        const DensitySampler::Place place = densities.indexAt(at);
        float hu = 0;
        if (densities.holds(place) && densities.sample(place, true, hu))
            highest = std::max(highest, hu);
    }
    return highest;
}

/// Points by cubes, so that only near ones are looked at.
class NearBlocks {
public:
    explicit NearBlocks(const MottledTagging& mottled) : side_mm_(mottled.block_mm)
    {
        for (const Point3& block : mottled.blocks_mm)
            cubes_[cubeOf(block)].push_back(block);
    }

    /// Whether the middle of one lies within so many sides, at most two.
    bool within(double sides, Point3 p) const
    {
        const double reach_mm = sides * side_mm_;
        const Cube at = cubeOf(p);
        for (int k = -2; k <= 2; ++k)
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i)
                    if (const auto found = cubes_.find({at[0] + i, at[1] + j, at[2] + k}); found != cubes_.end())
                        for (const Point3& block : found->second)
                            if (distance(block, p) <= reach_mm)
                                return true;
        return false;
    }

private:
    using Cube = std::array<int, 3>;
    Cube cubeOf(Point3 p) const
    {
        return {int(std::floor(p.x / side_mm_)), int(std::floor(p.y / side_mm_)), int(std::floor(p.z / side_mm_))};
    }

    double side_mm_;
    std::map<Cube, std::vector<Point3>> cubes_;
};

void addMottled(std::vector<float>& tagging, const std::vector<float>& points_mm, const MottledTagging& mottled)
{
    if (mottled.blocks_mm.empty())
        return;
    const NearBlocks blocks(mottled);
    tbb::parallel_for(std::size_t(0), tagging.size(), [&](std::size_t n) {
        const float* p = &points_mm[3 * n];
        const Point3 point{p[0], p[1], p[2]};
        if (blocks.within(kInMottled, point))
            tagging[n] = 2;
        else if (tagging[n] > 0 && blocks.within(kBesideMottled, point))
            tagging[n] += 1;
    });
}

/// As a disc of the wall's area, and a rim around it.
void addFaint(std::vector<float>& tagging, const std::vector<float>& points_mm, const std::vector<FaintWall>& walls)
{
    constexpr double kRim_mm = 2;
    for (const FaintWall& wall : walls) {
        const double reach_mm = std::sqrt(wall.area_mm2 / std::numbers::pi) + kRim_mm;
        tbb::parallel_for(std::size_t(0), tagging.size(), [&](std::size_t n) {
            const float* p = &points_mm[3 * n];
            if (distance({p[0], p[1], p[2]}, wall.middle_mm) <= reach_mm)
                tagging[n] = 2;
        });
    }
}

}  // namespace

TagDensities tagDensitiesOf(const std::vector<StepRecord>& steps)
{
    TagDensities densities;
    takeRecorded(steps, "segment.tissue_hu", densities.tissue_hu);
    takeRecorded(steps, "tissue.tag_contrast_hu", densities.contrast_hu);
    return densities;
}

std::vector<float> taggingOf(const std::vector<float>& points_mm, const std::vector<float>& normals,
                             const HuView& volume, const InsideView& inside, double noise_hu,
                             const TagDensities& densities, const Progress* wanted)
{
    const DensitySampler sampler(volume);
    const auto tissue_hu = float(densities.tissue_hu);
    const float from_hu = tissue_hu + std::max(float(densities.contrast_hu), kTagNoises * float(noise_hu));
    std::vector<float> tagging(std::min(points_mm.size(), normals.size()) / 3);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tagging.size(), 4096), [&](const auto& some) {
        if (wanted)
            wanted->check();
        for (std::size_t n = some.begin(); n < some.end(); ++n) {
            const float *p = &points_mm[3 * n], *v = &normals[3 * n];
            const float hu = highestBefore({p[0], p[1], p[2]}, {v[0], v[1], v[2]}, sampler, inside, tissue_hu);
            tagging[n] = std::clamp((hu - from_hu) / kTagRise_hu, 0.F, 1.F);
        }
    });
    return tagging;
}

void addUntrusted(std::vector<float>& tagging, const std::vector<float>& points_mm, const UntrustedWall& untrusted)
{
    addMottled(tagging, points_mm, untrusted.mottled);
    addFaint(tagging, points_mm, untrusted.faint);
}

}  // namespace vicon::viewer

#include "vicon/viewer/model/wall_tagging.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "density_sampler.h"

namespace vicon::viewer {
namespace {

// Soft tissue, and contrast medium in the mucosa, end some 120 HU above 40 HU, as tissue.tag_contrast_hu has it.
constexpr float kTissue_hu = 40, kLeastContrast_hu = 120;
constexpr float kTagNoises = 3;   // a density between voxels has less noise than a voxel: five of its own
constexpr float kTagRise_hu = 100;  // from where tagging begins to where it is sure
// A film is 1.5 mm thick in the mean (beyond.md); farther in stands what does not touch the wall.
constexpr float kTagReach_mm = 2.5F, kTagStep_mm = 0.5F;

/// The highest density on the way into the lumen, from the wall to where the lumen ends or is wide.
float highestBefore(Point3 point, Vector3 normal, const DensitySampler& densities, const InsideView& inside)
{
    float highest = kTissue_hu;
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

}  // namespace

std::vector<float> taggingOf(const std::vector<float>& points_mm, const std::vector<float>& normals,
                             const HuView& volume, const InsideView& inside, double noise_hu, const Progress* wanted)
{
    const DensitySampler densities(volume);
    const float from_hu = kTissue_hu + std::max(kLeastContrast_hu, kTagNoises * float(noise_hu));
    std::vector<float> tagging(std::min(points_mm.size(), normals.size()) / 3);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tagging.size(), 4096), [&](const auto& some) {
        if (wanted)
            wanted->check();
        for (std::size_t n = some.begin(); n < some.end(); ++n) {
            const float *p = &points_mm[3 * n], *v = &normals[3 * n];
            const float hu = highestBefore({p[0], p[1], p[2]}, {v[0], v[1], v[2]}, densities, inside);
            tagging[n] = std::clamp((hu - from_hu) / kTagRise_hu, 0.F, 1.F);
        }
    });
    return tagging;
}

}  // namespace vicon::viewer

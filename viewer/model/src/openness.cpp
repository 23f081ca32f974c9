#include "vicon/viewer/model/openness.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace vicon::viewer {
namespace {

struct Probe {
    double distance_mm, weight;
};
// From what is beside a polyp to what is beside a fold. Nearer than the first, a field of voxels says too little; what
// is beyond the last is farther than most colons are wide, and would only darken narrow ones.
constexpr std::array<Probe, 4> kProbes{{{2, 0.3}, {3.5, 0.3}, {5, 0.2}, {7.5, 0.2}}};

double opennessAt(Point3 point, Vector3 normal, const Lumen& lumen)
{
    const double unsure_mm = lumen.voxel_mm() / 4;  // what a field of voxels may be short by before plain wall
    double openness = 0;
    for (const Probe& probe : kProbes) {
        const double free_mm = lumen.clearance_mm(point + normal * probe.distance_mm);
        openness += probe.weight * std::min((free_mm + unsure_mm) / probe.distance_mm, 1.0);
    }
    return openness;
}

}  // namespace

std::vector<float> opennessOf(const std::vector<float>& points_mm, const std::vector<float>& normals,
                              const Lumen& lumen, const Progress* wanted)
{
    std::vector<float> openness(std::min(points_mm.size(), normals.size()) / 3);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, openness.size(), 4096), [&](const auto& some) {
        if (wanted)
            wanted->check();
        for (std::size_t n = some.begin(); n < some.end(); ++n) {
            const float *p = &points_mm[3 * n], *v = &normals[3 * n];
            openness[n] = float(opennessAt({p[0], p[1], p[2]}, {v[0], v[1], v[2]}, lumen));
        }
    });
    return openness;
}

}  // namespace vicon::viewer

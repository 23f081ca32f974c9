#include "vicon/viewer/model/acquired_wall.h"

#include "density_sampler.h"
#include "recorded_option.h"
#include "vicon/core/usual_densities.h"
#include "vicon/viewer/model/peeling.h"

namespace vicon::viewer {
namespace {
constexpr double kStepOfVoxel = 0.25;  // of its smallest side: no film of fluid that the picture shows is leapt over
}

double gasEndsOf_hu(const std::vector<StepRecord>& steps)
{
    double gas_ends_hu = kUsualWall_hu;
    takeRecorded(steps, "segment.wall_hu", gas_ends_hu);
    return gas_ends_hu;
}

bool startsInGas(const HuView& volume, double gas_ends_hu, Point3 eye_mm)
{
    return volume.valueOr(volume.grid.indexAt(eye_mm), kPaddingHu) < gas_ends_hu;
}

std::optional<double> distanceToAcquiredWall_mm(const HuView& volume, double gas_ends_hu, const Lumen& lumen,
                                                Point3 from, Vector3 direction, double reach_mm)
{
    const auto wall_mm = distanceToWall_mm(lumen, from, direction, reach_mm);
    if (!wall_mm || !startsInGas(volume, gas_ends_hu, from))
        return std::nullopt;
    const DensitySampler densities(volume);
    const double step_mm = kStepOfVoxel * lumen.voxel_mm();
    float before_hu = 0, here_hu = 0;
    bool sampled = false;
    for (double at_mm = 0; at_mm <= *wall_mm + kBehindWall_mm; at_mm += step_mm, before_hu = here_hu) {
        const DensitySampler::Place place = densities.indexAt(from + direction * at_mm);
        if (!densities.holds(place) || !densities.sample(place, true, here_hu)) {
            sampled = false;
            continue;
        }
        if (here_hu >= gas_ends_hu)
            return sampled ? at_mm - step_mm * (here_hu - gas_ends_hu) / double(here_hu - before_hu) : at_mm;
        sampled = true;
    }
    return std::nullopt;
}

double standingShare(const HuView& volume, double gas_ends_hu, const Lumen& lumen, const Pose& pose, const Lens& lens)
{
    constexpr int kRays = 9;                           // along each side
    constexpr double kReach_mm = 500, kStands_mm = 3;  // more than a film of fluid, and than where the two walls differ
    int stands = 0;
    for (int n = 0; n < kRays * kRays; ++n) {
        const int column = n % kRays, row = n / kRays;
        const Vector3 ray =
            rayThrough(pose, lens, {lens.width * (column + 0.5) / kRays, lens.height * (row + 0.5) / kRays});
        const auto acquired_mm = distanceToAcquiredWall_mm(volume, gas_ends_hu, lumen, pose.eye_mm, ray, kReach_mm);
        const auto wall_mm = distanceToWall_mm(lumen, pose.eye_mm, ray, kReach_mm);
        stands += acquired_mm && wall_mm && *acquired_mm < *wall_mm - kStands_mm ? 1 : 0;
    }
    return double(stands) / (kRays * kRays);
}

}  // namespace vicon::viewer

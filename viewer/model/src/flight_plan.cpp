#include "vicon/viewer/model/flight_plan.h"

#include <algorithm>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kSame_mm = 1e-6;
constexpr double kSmoothing_mm = 8;  // sigma of the direction's smoothing: about a lumen's radius

bool sameReach(const ViewPose& a, const ViewPose& b, double reach_mm)
{
    // Stations left out between two poses are a jump: what is on the other side does not turn the eye here.
    return std::abs(a.station_mm - b.station_mm) <= reach_mm;
}

std::vector<ViewPose> smoothed(const std::vector<ViewPose>& poses, double step_mm)
{
    const int reach = int(std::ceil(3 * kSmoothing_mm / step_mm));
    std::vector<ViewPose> out = poses;
    for (int n = 0; n < int(poses.size()); ++n) {
        Vector3 sum;
        for (int m = std::max(0, n - reach); m <= std::min(int(poses.size()) - 1, n + reach); ++m) {
            const double d = (m - n) * step_mm / kSmoothing_mm;
            if (sameReach(poses[std::size_t(n)], poses[std::size_t(m)], 1.5 * std::abs(m - n) * step_mm))
                sum += poses[std::size_t(m)].pose.forward * std::exp(-d * d / 2);
        }
        Pose& pose = out[std::size_t(n)].pose;
        if (length(sum) > 0)
            pose.forward = normalized(sum);
        pose.up = uprightOn(pose.forward, pose.up);
    }
    return out;
}

}  // namespace

std::vector<ViewPose> planFlight(const PathFrames& path, const Lumen& lumen, double step_mm, Heading heading,
                                 const ViewPoseOptions& options)
{
    if (!(step_mm > 0))
        throw Error(ErrorCode::wrong_use, "a flight's step must be above 0 mm");
    const double length = path.length_mm();
    const int steps = std::max(1, int(std::ceil(length / step_mm - 1e-9)));
    std::vector<ViewPose> poses;
    for (int n = 0; n <= steps; ++n) {
        const double station = std::min(n * step_mm, length);
        const ViewPose view =
            poseAtStation(path, lumen, heading == Heading::caecum ? station : length - station, heading, options);
        // A station that cannot be flown gets the pose of a neighbour. Where that is nearer to the next station, it has
        // had its turn or will have it.
        const double moved_mm = std::abs(view.station_mm - (heading == Heading::caecum ? station : length - station));
        const bool again = !poses.empty() && std::abs(poses.back().station_mm - view.station_mm) < kSame_mm;
        if (moved_mm < kSame_mm || (moved_mm < step_mm / 2 && !again))
            poses.push_back(view);
    }
    if (poses.empty())
        throw Error(ErrorCode::unusable_scan, "no part of the skeleton can be flown through", {},
                    "run 'vicon work' to prepare the scan anew");
    return smoothed(poses, step_mm);
}

}  // namespace vicon::viewer

#include "vicon/viewer/model/flight_plan.h"

#include <algorithm>
#include <cmath>

#include "vicon/core/error.h"

namespace vicon::viewer {
namespace {

constexpr double kSame_mm = 1e-6;
}  // namespace

std::vector<ViewPose> planFlight(const PathFrames& path, const Lumen& lumen, double step_mm, Heading heading)
{
    if (!path.isPath())
        throw Error(ErrorCode::wrong_use, "the organ has no centreline: it is flown freely", {},
                    "fly in the window, 'vicon read'");
    if (!(step_mm > 0))
        throw Error(ErrorCode::wrong_use, "a flight's step must be above 0 mm");
    const double length = path.length_mm();
    const int steps = std::max(1, int(std::ceil(length / step_mm - 1e-9)));
    const LookAhead ahead(path, lumen);
    std::vector<ViewPose> poses;
    for (int n = 0; n <= steps; ++n) {
        const double station = std::min(n * step_mm, length);
        const ViewPose view =
            poseAtStation(path, lumen, ahead, heading == Heading::caecum ? station : length - station, heading);
        // A station that cannot be flown gets the pose of a neighbour. Where that is nearer to the next station, it has
        // had its turn or will have it.
        const double moved_mm = std::abs(view.station_mm - (heading == Heading::caecum ? station : length - station));
        const bool again = !poses.empty() && std::abs(poses.back().station_mm - view.station_mm) < kSame_mm;
        if (moved_mm < kSame_mm || (moved_mm < step_mm / 2 && !again))
            poses.push_back(view);
    }
    if (poses.empty())
        throw Error(ErrorCode::unusable_scan, "no part of the centreline can be flown through", {},
                    "run 'vicon work' to prepare the scan anew");
    return poses;
}

}  // namespace vicon::viewer

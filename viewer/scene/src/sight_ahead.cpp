#include "vicon/viewer/scene/sight_ahead.h"

namespace vicon::viewer {

void SightAhead::prepare(const Pose& pose, const Lens& lens)
{
    wait();
    pose_ = pose;
    lens_ = lens;
    under_way_ = std::async(std::launch::async, [this, pose, lens] { return visibility_.seenFrom(pose, lens); });
}

SeenParts SightAhead::seenFrom(const Pose& pose, const Lens& lens)
{
    const bool same = pose == pose_ && lens == lens_;
    if (under_way_.valid() && same)
        return under_way_.get();
    return visibility_.seenFrom(pose, lens);
}

void SightAhead::wait() const
{
    if (under_way_.valid())
        under_way_.wait();
}

}  // namespace vicon::viewer

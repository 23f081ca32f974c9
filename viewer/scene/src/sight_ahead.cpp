#include "vicon/viewer/scene/sight_ahead.h"

#include <sys/resource.h>
#include <tbb/task_arena.h>
#include <unistd.h>

namespace vicon::viewer {
namespace {

/// What the calling thread does from now on waits for whoever draws: a picture's rasterizing threads wait for each
/// other, so one that loses its core for a time slice holds up the frame.
void yieldToDrawing()
{
    setpriority(PRIO_PROCESS, id_t(gettid()), 19);
}

}  // namespace

SightAhead::SightAhead(const CellVisibility& visibility)
    : visibility_(visibility), thread_([this](const std::stop_token& stop) { choose(stop); })
{
}

void SightAhead::prepare(const Pose& pose, const Lens& lens)
{
    wait();
    pose_ = pose;
    lens_ = lens;
    Choice choice([this, pose, lens] { return visibility_.visibleFrom(pose, lens); });
    under_way_ = choice.get_future();
    {
        const std::lock_guard lock(mutex_);
        next_ = std::move(choice);
    }
    wanted_.notify_one();
}

void SightAhead::choose(const std::stop_token& stop)
{
    yieldToDrawing();
    // In this thread alone: those that would help do not yield, and what is to be drawn keeps but one core busy while
    // it is taken in.
    tbb::task_arena alone(1);
    for (;;) {
        Choice choice;
        {
            std::unique_lock lock(mutex_);
            if (!wanted_.wait(lock, stop, [this] { return next_.valid(); }))
                return;
            choice = std::move(next_);
        }
        alone.execute([&] { choice(); });
    }
}

VisibleParts SightAhead::visibleFrom(const Pose& pose, const Lens& lens)
{
    const bool same = pose == pose_ && lens == lens_;
    if (under_way_.valid() && same)
        return under_way_.get();
    return visibility_.visibleFrom(pose, lens);
}

void SightAhead::wait() const
{
    if (under_way_.valid())
        under_way_.wait();
}

}  // namespace vicon::viewer

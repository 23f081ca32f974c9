#pragma once

#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>

#include "vicon/viewer/scene/cell_visibility.h"

namespace vicon::viewer {

/// Chooses what the next frame shows while the present one is drawn: a camera on its path knows where it is going, and
/// software OpenGL leaves a core idle while it takes in triangles. The answers are those of CellVisibility, to the bit.
class SightAhead {
public:
    /// `visibility` must live on.
    explicit SightAhead(const CellVisibility& visibility);
    /// Waits for what is under way.
    ~SightAhead() = default;
    SightAhead(const SightAhead&) = delete;
    SightAhead& operator=(const SightAhead&) = delete;

    /// Begins to choose for a frame to come, in a thread of its own; returns at once, unless an earlier choice is
    /// still under way.
    void prepare(const Pose& pose, const Lens& lens);
    /// The choice that was prepared for exactly this pose and lens; otherwise it is made now. Throws as
    /// CellVisibility::visibleFrom() does.
    VisibleParts visibleFrom(const Pose& pose, const Lens& lens);
    /// Returns when nothing is under way.
    void wait() const;

private:
    using Choice = std::packaged_task<VisibleParts()>;
    void choose(const std::stop_token& stop);

    const CellVisibility& visibility_;
    Pose pose_;
    Lens lens_;
    std::future<VisibleParts> under_way_;
    std::mutex mutex_;  ///< of what follows
    std::condition_variable_any wanted_;
    Choice next_;
    std::jthread thread_;  ///< kept from frame to frame: a new one costs a frame 0.05 ms
};

}  // namespace vicon::viewer

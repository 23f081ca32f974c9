#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "widgets/worker.h"

namespace vicon::viewer {

/// A worker and what only its thread may touch: the work that it does gets it, nobody else can. It goes when the thread
/// has ended.
template <class State>
class WorkerWith {
public:
    using Work = Worker::Work;

    /// @param state what follows is handed to its constructor
    template <class... Arguments>
    explicit WorkerWith(QObject* owner, Arguments&&... state)
        : state_(std::forward<Arguments>(state)...), worker_(owner)
    {
    }

    /// As Worker::postTask(); `work` is called with the state and, where it takes it, with the Progress.
    template <class WithState>
    void post(const std::string& name, WithState work)
    {
        worker_.postTask(name, [this, work = std::move(work)](Progress& progress) mutable {
            if constexpr (std::is_invocable_v<WithState&, State&, Progress&>)
                return Work(work(state_, progress));
            else
                return Work(work(state_));
        });
    }
    /// As Worker::postAlways().
    template <class WithState>
    void postAlways(WithState work)
    {
        post({}, std::move(work));
    }
    void end() { worker_.end(); }
    bool giveUp(const std::string& name) { return worker_.giveUp(name); }
    bool ended() const { return worker_.ended(); }
    /// For its signals.
    const Worker* worker() const { return &worker_; }

private:
    State state_;
    Worker worker_;  // ends first
};

}  // namespace vicon::viewer

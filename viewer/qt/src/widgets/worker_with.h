#pragma once

#include <memory>
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

    /// As Worker::post(); `work` is called with the state.
    template <class WithState>
    void post(const std::string& name, WithState work)
    {
        worker_.post(name, [this, work = std::move(work)]() mutable { return Work(work(state_)); });
    }
    /// As Worker::postAlways().
    template <class WithState>
    void postAlways(WithState work)
    {
        post({}, std::move(work));
    }
    void end() { worker_.end(); }
    bool ended() const { return worker_.ended(); }
    /// For its signals.
    const Worker* worker() const { return &worker_; }

private:
    State state_;
    Worker worker_;  // ends first
};

}  // namespace vicon::viewer

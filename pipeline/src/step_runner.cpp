#include "step_runner.h"

#include <algorithm>

namespace vicon::pipeline {

/// What a step tells of itself, as a part of the whole.
class StepRunner::StepProgress : public Progress {
public:
    StepProgress(StepRunner& runner, Task& task) : runner_(runner), task_(task) {}
    void report(double fraction, std::string_view what) override { runner_.report(task_, fraction, what); }
    bool cancelled() const override { return runner_.stopping_ || runner_.context_.cancelled(); }

private:
    StepRunner& runner_;
    Task& task_;
};

StepRunner::StepRunner(const std::vector<Step>& table, Hooks hooks, const StepInputs& inputs, ScanResults& results,
                       const StepRecords& records, JobContext& context, int at_once)
    : inputs_(inputs),
      results_(results),
      records_(records),
      context_(context),
      at_once_(at_once),
      hooks_(std::move(hooks)),
      tasks_(table.size())
{
    for (std::size_t n = 0; n < tasks_.size(); ++n)
        tasks_[n].step = &table[n];
}

StepRunner::~StepRunner()
{
    stopping_ = true;
    joinAll();
}

void StepRunner::joinAll()
{
    for (Task& task : tasks_)
        if (task.thread.joinable())
            task.thread.join();
}

void StepRunner::run()
{
    std::unique_lock lock(mutex_);
    while (!isOver() && !failure_) {
        context_.check();
        takeResults(lock);
        startReady(lock);
        if (!isOver())
            changed_.wait(lock, [this] { return failure_ || hasNews(); });
    }
    if (!failure_)
        return;
    stopping_ = true;
    lock.unlock();
    joinAll();
    lock.lock();
    takeResults(lock);  // what others finished meanwhile need not be done again
    std::rethrow_exception(failure_);
}

bool StepRunner::hasNews() const
{
    return std::any_of(tasks_.begin(), tasks_.end(), [this](const Task& task) {
        return (task.state == State::made && !task.told) ||
               (task.state == State::written && (!task.told || inputsAre(task, State::recorded)));
    });
}

/// Tells of what was made, then of what was written, inputs before what was made of them.
void StepRunner::takeResults(std::unique_lock<std::mutex>& lock)
{
    for (Task& task : tasks_)
        if ((task.state == State::made || task.state == State::written) && !task.told) {
            lock.unlock();
            hooks_.made(*task.step, std::move(task.result));
            lock.lock();
            task.told = true;
            endAfter(*task.step);
        }
    for (Task& task : tasks_)
        if (task.state == State::written && task.told && inputsAre(task, State::recorded)) {
            lock.unlock();
            hooks_.written(*task.step, task.seconds);
            lock.lock();
            task.state = State::recorded;
        }
    dropWhatNobodyNeeds();
}

void StepRunner::endAfter(const Step& step)
{
    if (hooks_.ends(step))
        for (Task& other : tasks_)
            if (other.state == State::waiting)
                other.state = State::skipped;
}

void StepRunner::startReady(std::unique_lock<std::mutex>& lock)
{
    for (Task& task : tasks_) {
        if (!canStart(task))
            continue;
        if (hooks_.is_due(*task.step)) {
            start(task, lock);
        } else {
            task.state = State::skipped;
            endAfter(*task.step);
        }
    }
}

bool StepRunner::canStart(const Task& task) const
{
    const auto busy = std::count_if(tasks_.begin(), tasks_.end(), [](const Task& other) {
        return other.state == State::running || other.state == State::made || other.state == State::written;
    });
    return task.state == State::waiting && busy < at_once_ && inputsAre(task, State::made);
}

/// Whether all that the step reads is made (and told), or recorded.
bool StepRunner::inputsAre(const Task& task, State least) const
{
    const auto& names = task.step->inputs;
    return std::all_of(tasks_.begin(), tasks_.end(), [&](const Task& other) {
        if (std::find(names.begin(), names.end(), other.step->name) == names.end())
            return true;
        return other.state == State::skipped || (other.state >= least && (other.told || least != State::made));
    });
}

void StepRunner::start(Task& task, std::unique_lock<std::mutex>& lock)
{
    task.state = State::running;
    task.start = std::chrono::steady_clock::now();
    std::string names;
    for (const Task& other : tasks_)
        if (other.state == State::running)
            names += (names.empty() ? "" : ", ") + other.step->name;
    lock.unlock();
    context_.enterStep(names, 0, 1);
    lock.lock();
    task.thread = std::thread([this, &task, records = records_] { work(task, records); });
}

void StepRunner::work(Task& task, const StepRecords& records)
{
    const auto become = [&](State state) {
        const std::lock_guard lock(mutex_);
        task.state = state;
        task.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - task.start).count();
        changed_.notify_all();
    };
    try {
        StepProgress progress(*this, task);
        task.result = task.step->run(inputs_, results_, records, progress);
        const std::vector<std::string> files = task.step->outputs(task.result);
        become(State::made);
        results_.finish(files);
        become(State::written);
    } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_)
            failure_ = std::current_exception();
        stopping_ = true;
        changed_.notify_all();
    }
}

void StepRunner::report(Task& task, double fraction, std::string_view what)
{
    const std::lock_guard lock(mutex_);
    task.fraction = std::max(task.fraction, std::clamp(fraction, 0.0, 1.0));  // a step may do a part of its work again
    context_.report(whole(), what);
}

/// Part of the whole job that is done.
double StepRunner::whole() const
{
    double sum = 0;
    for (const Task& task : tasks_)
        sum += (task.step->to - task.step->from) * (task.state == State::waiting   ? 0
                                                    : task.state == State::running ? task.fraction
                                                                                   : 1);
    return sum;
}

bool StepRunner::isOver() const
{
    return std::all_of(tasks_.begin(), tasks_.end(),
                       [](const Task& task) { return task.state == State::recorded || task.state == State::skipped; });
}

/// The densities are the largest thing of all.
void StepRunner::dropWhatNobodyNeeds()
{
    const auto needed = [this](Densities densities) {
        return std::any_of(tasks_.begin(), tasks_.end(), [densities](const Task& task) {
            const bool makes = task.step->inputs.empty();  // they must be on the disk first
            return task.step->densities == densities &&
                   (task.state == State::waiting || task.state == State::running ||
                    (makes && task.state != State::recorded && task.state != State::skipped));
        });
    };
    if (!needed(Densities::whole))
        results_.dropVolume();
    if (!needed(Densities::around_lumen))
        results_.dropDensitiesAroundLumen();
}

}  // namespace vicon::pipeline

#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "scan_results.h"
#include "step_table.h"
#include "vicon/pipeline/worker.h"

namespace vicon::pipeline {

/// Runs the steps of one scan, each in a thread of its own as soon as what it reads was made. A step is first *made*
/// (its results are in memory, other steps may start), then *written* (its files are on the disk, it may be recorded).
/// Everything that speaks to the queue happens in the thread that calls run().
class StepRunner {
public:
    struct Hooks {
        /// Whether the step must run at all; asked when all its inputs are made.
        std::function<bool(const Step&)> is_due;
        /// The step's result, before any step that reads it starts.
        std::function<void(const Step&, nlohmann::json result)> made;
        /// Whether no further step starts, asked of every step that is made or need not run.
        std::function<bool(const Step&)> ends;
        /// The step's files are on the disk, and those of all its inputs were before.
        std::function<void(const Step&, double seconds)> written;
    };

    /// @param table the steps, each after those it reads
    /// @param at_once steps that may be at work or being written at the same time, at least 1
    StepRunner(const std::vector<Step>& table, Hooks hooks, const StepInputs& inputs, ScanResults& results,
               const StepRecords& records, JobContext& context, int at_once);
    /// Waits for the steps that are at work.
    ~StepRunner();
    StepRunner(const StepRunner&) = delete;
    StepRunner& operator=(const StepRunner&) = delete;

    /// Throws what the first step to fail threw, once all others have stopped; Error{cancelled} when told to stop.
    void run();

private:
    enum class State { waiting, running, made, written, recorded, skipped };  // in this order
    struct Task {
        const Step* step = nullptr;
        State state = State::waiting;
        bool told = false;  ///< the hook `made` was called
        nlohmann::json result;
        double fraction = 0;
        std::chrono::steady_clock::time_point start;
        double seconds = 0;
        std::thread thread;
    };
    class StepProgress;

    bool hasNews() const;
    void startReady(std::unique_lock<std::mutex>& lock);
    void takeResults(std::unique_lock<std::mutex>& lock);
    bool canStart(const Task& task) const;
    bool inputsAre(const Task& task, State least) const;
    void start(Task& task, std::unique_lock<std::mutex>& lock);
    void work(Task& task, const StepRecords& records);
    void endAfter(const Step& step);
    void joinAll();
    void report(Task& task, double fraction, std::string_view what);
    double whole() const;
    bool isOver() const;
    void dropWhatNobodyNeeds();

    const StepInputs& inputs_;
    ScanResults& results_;
    const StepRecords& records_;
    JobContext& context_;
    int at_once_;
    Hooks hooks_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Task> tasks_;
    std::exception_ptr failure_;
    std::atomic<bool> stopping_ = false;
};

}  // namespace vicon::pipeline

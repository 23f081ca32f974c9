#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include "vicon/core/progress.h"

namespace vicon::app {

/// Shows progress on stderr: a bar on a terminal, a plain line every few seconds otherwise, none before them. Cancelled
/// by SIGINT and SIGTERM.
class ProgressLine : public Progress {
public:
    explicit ProgressLine(std::string title);
    ~ProgressLine() override;
    void report(double fraction, std::string_view what) override;
    bool cancelled() const override;
    /// Removes the bar, so that something else can be printed.
    void clear();
    void rename(const std::string& title);

private:
    std::mutex mutex_;
    std::string title_;
    bool terminal_;
    bool drawn_ = false;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace vicon::app

#pragma once

#include <atomic>
#include <memory>

#include "vicon/core/progress.h"

namespace vicon::viewer {

/// Whether work on another thread is still wanted.
class Wanted : public Progress {
public:
    void report(double, std::string_view) override {}
    bool cancelled() const override { return given_up_; }
    void giveUp() { given_up_ = true; }

private:
    std::atomic<bool> given_up_ = false;
};

}  // namespace vicon::viewer

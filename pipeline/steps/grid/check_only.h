#pragma once

#include <string_view>

#include "vicon/core/progress.h"

namespace vicon::steps {

/// For work on several threads at once: tells nothing, and stops when the whole is cancelled.
class CheckOnly : public Progress {
public:
    explicit CheckOnly(const Progress& whole) : whole_(whole) {}
    void report(double, std::string_view) override {}
    bool cancelled() const override { return whole_.cancelled(); }

private:
    const Progress& whole_;
};

}  // namespace vicon::steps

#pragma once

#include <string_view>

#include "vicon/core/progress.h"

namespace vicon::pipeline {

/// Tells the progress of a part as a part of the whole.
class PartOfProgress : public Progress {
public:
    PartOfProgress(Progress& whole, double from, double to) : whole_(whole), from_(from), to_(to) {}
    void report(double fraction, std::string_view what) override
    {
        whole_.report(from_ + (to_ - from_) * fraction, what);
    }
    bool cancelled() const override { return whole_.cancelled(); }

private:
    Progress& whole_;
    double from_, to_;
};

}  // namespace vicon::pipeline

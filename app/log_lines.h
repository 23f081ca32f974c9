#pragma once

#include <string>

#include "vicon/core/options.h"

namespace vicon::app {

struct LogOptions {
    std::string format = "text";

    template <class Visitor>
    void visit(Visitor&& v)
    {
        v("log.format", format, "", "What a line of the log is.", {-1e300, 1e300, {"text", "json"}});
    }
};

/// The log on standard error: one line an event, with its time in UTC, whatever its message holds.
void writeLogAs(const LogOptions& options);

}  // namespace vicon::app

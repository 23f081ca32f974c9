#pragma once

#include <string>
#include <vector>

namespace vicon::bench {

/// What a process had used at a moment.
struct Sample {
    double at_s = 0;  ///< from its start
    double cpu_s = 0;
    double resident_mb = 0;
};

/// What a process used from its start to its end, with all processes that it waited for.
struct Usage {
    double wall_s = 0;
    double cpu_s = 0;             ///< of all threads together
    double peak_mb = 0;           ///< resident set
    std::vector<Sample> samples;  ///< every 10 ms, the last one at its end
    int exit_code = -1;
};

/// Runs a program to its end, its output in a file.
Usage runToEnd(const std::vector<std::string>& command, const std::string& output_file);

}  // namespace vicon::bench

#pragma once

#include <string>
#include <vector>

namespace vicon::bench {

/// What a process used from its start to its end, with all processes that it waited for.
struct Usage {
    double wall_s = 0;
    double cpu_s = 0;      ///< of all threads together
    double peak_mb = 0;    ///< resident set
    double peak_at_s = 0;  ///< when the largest resident set was seen, from the start
    int exit_code = -1;
};

/// Runs a program to its end, its output in a file; the resident set is looked at every 10 ms.
Usage runToEnd(const std::vector<std::string>& command, const std::string& output_file);

}  // namespace vicon::bench

#pragma once

#include <string>
#include <vector>

namespace vicon {

inline constexpr int kNoSuchProgram = 127;

/// How a program ended: kNoSuchProgram where there is none of that name, and the last of what it said of its troubles.
struct ProgramEnd {
    int exit_code = 0;
    std::string said;
};

/// Runs a program of this machine, found by PATH, and waits for it. Throws Error{internal} when none can be run.
ProgramEnd runProgram(std::vector<std::string> arguments);

}  // namespace vicon

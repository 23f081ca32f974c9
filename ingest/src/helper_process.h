#pragma once

#include <sys/types.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "helper_protocol.h"

namespace vicon::ingest {

/// The decoder program has ended while it was asked something: by a signal, or because it took too long.
class HelperDied : public std::runtime_error {
public:
    HelperDied(const std::string& how, bool too_slow) : std::runtime_error(how), too_slow(too_slow) {}
    bool too_slow;
};

/// One running decoder program: a process of its own with limits on memory and time, no network and no files, so that a
/// stream or a file that breaks a library breaks nothing else. It ends with this object.
class HelperProcess {
public:
    /// Throws Error{internal} when the program is not there or cannot be started.
    HelperProcess();
    ~HelperProcess();
    HelperProcess(const HelperProcess&) = delete;
    HelperProcess& operator=(const HelperProcess&) = delete;

    /// Asks and waits for the answer's payload.
    /// @param descriptor passed along, or -1
    /// @param most_bytes an answer that is longer is not believed
    /// Throws HelperDied, or Error{internal} when the program cannot be confined, after which the object is of no use;
    /// Error{bad_input} with the program's reason.
    std::vector<char> ask(const HelperRequest& request, std::string_view payload, int descriptor,
                          std::size_t most_bytes);

private:
    using Clock = std::chrono::steady_clock;
    void send(const HelperRequest& request, std::string_view payload, int descriptor, Clock::time_point until);
    void receive(char* to, std::size_t count, Clock::time_point until);
    void waitFor(short events, Clock::time_point until);
    [[noreturn]] void died();

    pid_t process_ = -1;
    int socket_ = -1;
};

}  // namespace vicon::ingest

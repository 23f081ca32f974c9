#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "vicon/cases/case_store.h"

namespace vicon::app {

/// Writes a line that is of no case into the trail of a store, where there is one. Where it cannot be written the log
/// says so, and what was done goes on.
void auditOperation(const StorePlace& place, AuditEvent event, const std::string& detail);

/// The same of an account that the roles refuse: that is told in any case, also where no line can be written, as by an
/// account that may not write into the store.
void auditRefusedAccount(const StorePlace& place, const std::string& what);

/// Lines of a program's start and, when it is destroyed, its end.
class AuditedRun {
public:
    /// @param program its subcommand
    AuditedRun(StorePlace place, std::string program);
    ~AuditedRun();
    AuditedRun(const AuditedRun&) = delete;
    AuditedRun& operator=(const AuditedRun&) = delete;

private:
    StorePlace place_;
    std::string program_;
};

/// Lines of callers that a listener refused: of each host the first at once, and the others of a minute in one, so that
/// no caller fills the store. For all threads.
class RefusedCallers {
public:
    using Clock = std::function<std::chrono::steady_clock::time_point()>;
    explicit RefusedCallers(StorePlace place, Clock clock = std::chrono::steady_clock::now);
    void note(const std::string& host, const std::string& line);

private:
    struct Host {
        std::chrono::steady_clock::time_point told;
        int untold = 0;
    };
    StorePlace place_;
    Clock clock_;
    std::mutex mutex_;
    std::map<std::string, Host> hosts_;
};

}  // namespace vicon::app

#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "caller_rules.h"
#include "vicon/ingest/receiver.h"

namespace vicon::ingest {

/// Requests for commitment that peers made and that are not yet answered, a durable file each. The association that
/// asked may answer at once; what it leaves is reported over an association of its own, by a thread, until the peer has
/// taken it.
class CommitmentDesk {
public:
    /// @param folder where the requests lie; those of an earlier run are answered
    CommitmentDesk(std::filesystem::path folder, const ReceiverOptions& options, const Receiver::Handlers& handlers,
                   const CallerRules& rules);
    ~CommitmentDesk();
    CommitmentDesk(const CommitmentDesk&) = delete;
    CommitmentDesk& operator=(const CommitmentDesk&) = delete;

    void start();
    void finish();

    /// Whether commitments are given here.
    bool isOpen() const { return bool(handlers_.on_demand); }
    /// Keeps a request durably; the same transaction of the same peer is one. Nobody reports it before putBack().
    /// Returns its number. Throws Error{no_memory} when too many wait, Error{store}.
    std::string take(const std::string& title, const std::string& host, const CommitmentDemand& demand);
    CommitmentReport answer(const CommitmentDemand& demand) const { return handlers_.on_demand(demand); }
    /// The peer has taken the answer.
    void close(const std::string& number);
    /// To be reported over an association of its own.
    void putBack(const std::string& number);

private:
    using Time = std::chrono::steady_clock::time_point;
    struct Waiting {
        Time not_before;
        int failures = 0;
        bool held = false;  ///< by the association that asked
    };
    void work();
    std::string nextDue() const;
    void report(const std::string& number);
    std::filesystem::path fileOf(const std::string& number) const;

    const std::filesystem::path folder_;
    const ReceiverOptions& options_;
    const Receiver::Handlers& handlers_;
    const CallerRules& rules_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, Waiting> waiting_;
    bool finishing_ = false;
    std::thread thread_;
};

}  // namespace vicon::ingest

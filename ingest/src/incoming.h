#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "vicon/ingest/receiver.h"

namespace vicon::ingest {

/// What has been received and waits to be taken: one folder below `incoming` for each association. A thread hands over
/// what is complete, one call at a time.
class Incoming {
public:
    /// Finds what an earlier run left. Throws Error{store} when another receiver uses the folder.
    Incoming(std::filesystem::path folder, double idle_s, Receiver::OnReceived on_received,
             Receiver::OnTrouble on_trouble);
    ~Incoming();
    Incoming(const Incoming&) = delete;
    Incoming& operator=(const Incoming&) = delete;

    void start();
    /// Hands over everything that is complete, and ends the thread.
    void finish();

    /// A folder of its own for an association.
    std::filesystem::path open();
    /// A file that lies durably in the folder.
    void add(const std::filesystem::path& folder, const std::filesystem::path& file);
    /// The association is over.
    void close(const std::filesystem::path& folder);
    void trouble(const std::string& what) const;

private:
    struct Batch {
        std::vector<std::filesystem::path> files;
        std::chrono::steady_clock::time_point last;
        bool closed = false;
    };
    void findLeftovers();
    void work();
    bool handOverOne(std::unique_lock<std::mutex>& lock);

    std::filesystem::path folder_;
    std::chrono::duration<double> idle_;
    Receiver::OnReceived on_received_;
    Receiver::OnTrouble on_trouble_;
    int lock_descriptor_ = -1;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::filesystem::path, Batch> batches_;
    bool finishing_ = false;
    int count_ = 0;
    std::thread thread_;
};

}  // namespace vicon::ingest

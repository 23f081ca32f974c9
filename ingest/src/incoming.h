#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "arrival_journal.h"
#include "vicon/ingest/receiver.h"

namespace vicon::ingest {

/// In the incoming folder for as long as the store is there; locked while a receiver works for it.
inline constexpr const char* kReceiverLock = "receiver.lock";
inline constexpr const char* kStoreIsGone = "the store is gone";

inline bool isStoreOf(const std::filesystem::path& incoming)
{
    std::error_code none;
    return std::filesystem::exists(incoming / kReceiverLock, none);
}

/// What has been received and waits to be taken: one folder below `incoming` for each association. A thread hands over
/// the objects of one study at a time, once no association sends it any more and a quiet time has passed. What cannot
/// be taken is tried again; what no case takes goes to the store's quarantine.
class Incoming {
public:
    struct Pauses {
        double quiet_s = 5;         ///< after the last object of a study, once its associations are closed
        double idle_s = 10;         ///< after the last object of a study whose association stays open
        double incomplete_s = 900;  ///< for objects that are known to be missing, after the last that came
    };

    /// Finds what an earlier run left. Throws Error{store} when another receiver uses the folder.
    Incoming(std::filesystem::path folder, Pauses pauses, const Receiver::Handlers& handlers);
    ~Incoming();
    Incoming(const Incoming&) = delete;
    Incoming& operator=(const Incoming&) = delete;

    void start();
    /// Hands over everything that is complete, and ends the thread.
    void finish();

    /// The name of a folder of its own for an association of this caller, which is made with its first object.
    std::filesystem::path open(const std::string& caller = {});
    /// How many objects of this caller wait to be taken.
    int waitingOf(const std::string& caller);
    /// Takes an object of a study that was received under another name: when this returns, it lies durably in its
    /// folder. Throws Error{store}.
    void add(const std::filesystem::path& folder, const std::filesystem::path& received,
             const std::filesystem::path& file, const std::string& study);
    /// The association is over.
    void close(const std::filesystem::path& folder);
    void trouble(const std::string& what) const;

private:
    using Time = std::chrono::steady_clock::time_point;
    using Files = std::vector<std::filesystem::path>;
    struct Batch {
        Files files;
        std::set<std::filesystem::path> open;  ///< associations that sent of it and are not over
        Time last;
        Time not_before;  ///< held back after a failure
        int failures = 0;
        int deaths = 0;   ///< of processes that were taking exactly these files
        int missing = 0;  ///< objects that are known not to have come
        int asked = 0;    ///< how often it was missing some since the last object came
        Time incomplete_since;
    };
    void lockFolder();
    void findLeftovers();
    void work();
    bool isReady(const Batch& batch) const;
    bool waitsForMore(const std::string& study, Batch& batch);
    void putBack(const std::string& study, const Batch& taken);
    bool handOverOne(std::unique_lock<std::mutex>& lock);
    bool isGone();
    void waitForStore();
    /// False when it is to be tried again later.
    bool take(const Files& files, int deaths);
    bool takeInHalves(const Files& files, const std::string& why);
    void quarantine(const Files& files, const std::string& why);
    void forget(const Files& files);

    std::filesystem::path folder_;
    Pauses pauses_;
    const Receiver::Handlers& handlers_;
    int lock_descriptor_ = -1;
    std::unique_ptr<ArrivalJournal> journal_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::map<std::string, Batch> batches_;  ///< by study
    std::set<std::filesystem::path> open_;
    std::map<std::filesystem::path, std::string> callers_;  ///< by folder, as long as it is there
    std::map<std::string, int> waiting_;                    ///< objects, by caller
    bool finishing_ = false;
    bool told_to_stop_ = false;
    bool said_gone_ = false;
    int count_ = 0;
    std::thread thread_;
};

}  // namespace vicon::ingest

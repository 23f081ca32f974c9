#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "orthanc.h"
#include "vicon/ingest/receiver.h"

namespace vicon::test {

/// What a receiver may have beside its store.
struct Surroundings {
    std::vector<ingest::Peer> peers = {};
    ingest::TlsOptions tls = {};
    ingest::Receiver::OnDemand on_demand = {};
    ingest::Receiver::OnCommitment on_commitment = {};
    ingest::Receiver::OnQuiet on_quiet = {};
};

/// A receiver on a thread of its own, and what it handed over.
class RunningReceiver {
public:
    RunningReceiver(const fs::path& incoming, ingest::ReceiverOptions options,
                    std::function<void(const std::vector<fs::path>&)> also = {}, std::set<std::string> not_taken = {},
                    const Surroundings& surroundings = {})
        : not_taken_(std::move(not_taken)),
          receiver_(with(options), incoming,
                    {.on_received =
                         [this, also](const std::vector<fs::path>& files) {
                             if (also)
                                 also(files);
                             return take(files);
                         },
                     .on_trouble = [this](const std::string& what) { note(troubles_, what); },
                     .on_note = [this](const std::string& what) { note(notes_, what); },
                     .on_commitment = surroundings.on_commitment,
                     .on_demand = surroundings.on_demand,
                     .on_quiet = surroundings.on_quiet},
                    {surroundings.peers, surroundings.tls}),
          thread_([this] { receiver_.run(stop_); })
    {
    }
    ~RunningReceiver() { stop(); }
    void stop()
    {
        stop_ = true;
        if (thread_.joinable())
            thread_.join();
    }
    std::vector<std::string> waitFor(std::size_t count)
    {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, kPatience, [&] { return contents_.size() >= count; });
        return contents_;
    }
    int port() const { return receiver_.port(); }
    std::shared_ptr<const ingest::ReceiverCounts> counts() const { return receiver_.counts(); }
    ingest::Peer peer() const { return {"receiver", "127.0.0.1", "VICON", port()}; }
    std::vector<std::string> troubles()
    {
        const std::lock_guard lock(mutex_);
        return troubles_;
    }
    /// Whether a trouble or a note with these words comes.
    bool tells(const std::string& words)
    {
        const auto said = [&](const std::string& line) { return line.find(words) != std::string::npos; };
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, kPatience, [&] {
            return std::any_of(troubles_.begin(), troubles_.end(), said) ||
                   std::any_of(notes_.begin(), notes_.end(), said);
        });
    }
    int calls()
    {
        const std::lock_guard lock(mutex_);
        return calls_;
    }

private:
    static ingest::ReceiverOptions with(ingest::ReceiverOptions options)
    {
        if (options.port == ingest::ReceiverOptions{}.port)
            options.port = 0;
        if (options.quiet_s == ingest::ReceiverOptions{}.quiet_s)
            options.quiet_s = 0;
        return options;
    }
    std::vector<fs::path> take(const std::vector<fs::path>& files)
    {
        const std::lock_guard lock(mutex_);
        std::vector<fs::path> left;
        for (const fs::path& file : files) {
            contents_.push_back(readFile(file));
            if (not_taken_.contains(contents_.back()))
                left.push_back(file);
        }
        ++calls_;
        changed_.notify_all();
        return left;
    }
    void note(std::vector<std::string>& list, const std::string& what)
    {
        const std::lock_guard lock(mutex_);
        list.push_back(what);
        changed_.notify_all();
    }
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<std::string> contents_, troubles_, notes_;
    std::set<std::string> not_taken_;
    int calls_ = 0;
    std::atomic<bool> stop_ = false;
    ingest::Receiver receiver_;
    std::thread thread_;
};

}  // namespace vicon::test

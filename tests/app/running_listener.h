#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "orthanc.h"
#include "vicon/support/support.h"

namespace vicon::support {

/// 'vicon receive --no-work' from outside.
class RunningListener {
public:
    /// @param more arguments, as "--set receive.quiet_s=0"
    /// @param port 0: one that it chooses
    explicit RunningListener(const std::filesystem::path& store, const std::string& more = "", int port = 0)
        : log_(store.parent_path() / "listener.log"), said_(store.parent_path() / "listener.out")
    {
        std::filesystem::create_directories(store.parent_path());
        std::filesystem::remove(said_);  // what an earlier one said
        const std::string line = "exec " + viconBinary() + " receive --no-work --port " + std::to_string(port) +
                                 " --store " + store.string() + " " + more + " >" + said_.string() + " 2>>" +
                                 log_.string();
        process_ = ::fork();
        if (process_ == 0) {
            ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            ::_exit(127);
        }
        waitUntil([this] { return (port_ = portSaid()) != 0; });
    }
    ~RunningListener() { end(SIGTERM); }
    RunningListener(const RunningListener&) = delete;
    RunningListener& operator=(const RunningListener&) = delete;

    void end(int signal)
    {
        if (process_ <= 0)
            return;
        ::kill(process_, signal);
        ::waitpid(process_, nullptr, 0);
        process_ = -1;
    }
    ingest::Peer peer() const { return {"vicon", "127.0.0.1", "VICON", port_}; }
    bool answers() const { return port_ != 0 && test::comesToAnswer(peer()); }
    pid_t process() const { return process_; }
    std::string log() const { return readFile(log_); }

private:
    /// 0: it has not said yet on which it listens.
    int portSaid() const
    {
        int port = 0;
        if (std::filesystem::exists(said_))
            std::sscanf(readFile(said_).c_str(), "listening on port %d", &port);
        return port;
    }

    std::filesystem::path log_, said_;
    int port_ = 0;
    pid_t process_ = -1;
};

}  // namespace vicon::support

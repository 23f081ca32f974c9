#include "worker_processes.h"

#include <spawn.h>
#include <spdlog/spdlog.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <thread>

#include "vicon/core/error.h"

namespace vicon::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kThisProgram = "/proc/self/exe";
constexpr std::chrono::milliseconds kLook{50};
/// Before one that ended is replaced; twice as long each time that its successor does not last, up to the most.
constexpr std::chrono::seconds kFirstPause{1}, kMostPause{60};
/// One that worked as long as this did not end for what ended those before.
constexpr std::chrono::seconds kLasting = kMostPause;

std::vector<std::string> commandOf(const Context& context, bool until_idle)
{
    std::vector<std::string> command{"vicon", "work", "--store", context.storeFolder().string()};
    if (!context.config_file.empty())
        command.insert(command.end(), {"--config", context.config_file});
    for (const std::string& assignment : context.assignments)
        command.insert(command.end(), {"--set", assignment});
    if (context.json)
        command.emplace_back("--json");
    if (until_idle)
        command.emplace_back("--until-idle");
    return command;
}

pid_t start(std::vector<std::string> command)
{
    std::vector<char*> arguments;
    for (std::string& argument : command)
        arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    if (const int fault = ::posix_spawn(&process, kThisProgram, nullptr, nullptr, arguments.data(), environ);
        fault != 0)
        throw Error(ErrorCode::no_memory, std::string("a worker cannot be started (") + std::strerror(fault) + ")");
    return process;
}

std::string howItEnded(int status)
{
    return WIFSIGNALED(status) ? std::string("a worker was killed by signal ") + std::to_string(WTERMSIG(status))
                               : "a worker ended with exit code " + std::to_string(WEXITSTATUS(status));
}

/// What one worker after another does.
class Post {
public:
    explicit Post(const std::vector<std::string>& command) : command_(command), process_(start(command)) {}

    void tell(int signal) const
    {
        if (process_ != 0)
            ::kill(process_, signal);
    }
    /// Of a worker that has ended since the last call; nothing while it works, or the next one is not due.
    std::optional<int> ended()
    {
        int status = 0;
        if (process_ == 0 || ::waitpid(process_, &status, WNOHANG) != process_)
            return {};
        process_ = 0;
        return status;
    }
    bool manned() const { return process_ != 0; }
    void replaceLater(const std::string& why)
    {
        pause_ = Clock::now() - started_ >= kLasting ? kFirstPause : std::min(next_pause_, kMostPause);
        next_pause_ = 2 * pause_;
        due_ = Clock::now() + pause_;
        spdlog::warn("{}; another one starts in {} s", why, pause_.count());
    }
    void replaceWhenDue()
    try {
        if (process_ != 0 || Clock::now() < due_)
            return;
        started_ = Clock::now();
        process_ = start(command_);
    } catch (const Error& e) {
        replaceLater(e.what());
    }

private:
    std::vector<std::string> command_;
    pid_t process_ = 0;  ///< 0: nobody until it is due
    Clock::time_point started_ = Clock::now(), due_;
    std::chrono::seconds pause_{0}, next_pause_ = kFirstPause;
};

int exitCodeOf(int status)
{
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

int runWorkers(Context& context, int count, bool until_idle)
{
    const std::vector<std::string> command = commandOf(context, until_idle);
    std::vector<Post> posts;
    for (int n = 0; n < count; ++n)
        posts.emplace_back(command);
    int worst = 0;
    bool told = false;
    while (!posts.empty()) {
        if (stopRequested() && !std::exchange(told, true))
            for (const Post& post : posts)
                post.tell(SIGTERM);
        std::erase_if(posts, [&](Post& post) {
            const std::optional<int> status = post.ended();
            if (status && (stopRequested() || (until_idle && WIFEXITED(*status)))) {
                worst = std::max(worst, exitCodeOf(*status));
                return true;
            }
            if (status)
                post.replaceLater(howItEnded(*status));
            if (told)
                return !post.manned();
            post.replaceWhenDue();
            return false;
        });
        std::this_thread::sleep_for(kLook);
    }
    return worst;
}

}  // namespace vicon::app

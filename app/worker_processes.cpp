#include "worker_processes.h"

#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "vicon/core/error.h"

namespace vicon::app {
namespace {

constexpr const char* kThisProgram = "/proc/self/exe";
constexpr std::chrono::milliseconds kLook{50};
/// One that dies at once again and again is not replaced for ever.
constexpr std::chrono::seconds kBetweenReplacements{1};

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

}  // namespace

int runWorkers(Context& context, int count, bool until_idle)
{
    const std::vector<std::string> command = commandOf(context, until_idle);
    std::vector<pid_t> workers;
    for (int n = 0; n < count; ++n)
        workers.push_back(start(command));
    int worst = 0;
    bool told = false;
    while (!workers.empty()) {
        if (stopRequested() && !std::exchange(told, true))
            for (const pid_t worker : workers)
                ::kill(worker, SIGTERM);
        std::erase_if(workers, [&](pid_t& worker) {
            int status = 0;
            if (::waitpid(worker, &status, WNOHANG) != worker)
                return false;
            if (WIFEXITED(status) || told) {
                worst = std::max(worst, WIFEXITED(status) ? WEXITSTATUS(status) : 1);
                return true;
            }
            std::this_thread::sleep_for(kBetweenReplacements);
            worker = start(command);
            return false;
        });
        std::this_thread::sleep_for(kLook);
    }
    return worst;
}

}  // namespace vicon::app

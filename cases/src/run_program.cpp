#include "run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "vicon/core/error.h"

namespace vicon {
namespace {

constexpr std::size_t kMostSaid = 2000;

/// What comes out of a pipe until its writers are gone; only the end of it is kept.
std::string endOfWhatComes(int descriptor)
{
    std::string said;
    std::array<char, 4096> block{};
    for (ssize_t count = 0; (count = ::read(descriptor, block.data(), block.size())) != 0;) {
        if (count < 0 && errno != EINTR)
            break;
        said.append(block.data(), std::size_t(std::max<ssize_t>(count, 0)));
        if (said.size() > kMostSaid)
            said.erase(0, said.size() - kMostSaid);
    }
    return said;
}

}  // namespace

ProgramEnd runProgram(std::vector<std::string> arguments)
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error(ErrorCode::internal, std::string("no program can be run (") + std::strerror(errno) + ")");
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t process = 0;
    const int fault = ::posix_spawnp(&process, pointers[0], &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    ProgramEnd end{fault == 0 ? 0 : kNoSuchProgram, fault == 0 ? endOfWhatComes(ends[0]) : std::strerror(fault)};
    ::close(ends[0]);
    int status = 0;
    if (fault == 0 && ::waitpid(process, &status, 0) == process)
        end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : kNoSuchProgram;
    return end;
}

}  // namespace vicon

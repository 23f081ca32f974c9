#include "helper_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "vicon/core/error.h"

namespace fs = std::filesystem;

namespace vicon::ingest {
namespace {

constexpr const char* kProgram = "vicon-decoder";
/// Processor time ends a decoder that computes; this, times that, one that waits for a processor or for nothing.
constexpr int kPatience = 10;

/// Beside this program, where it is installed, or above it, in a folder of builds.
fs::path findProgram()
{
    std::error_code failure;
    const fs::path self = fs::read_symlink("/proc/self/exe", failure);
    if (fs::path installed = self.parent_path() / "../libexec/vicon" / kProgram; fs::exists(installed, failure))
        return installed;
    constexpr int kLevels = 4;
    fs::path folder = self.parent_path();
    for (int level = 0; level < kLevels; ++level, folder = folder.parent_path())
        if (fs::exists(folder / kProgram, failure))
            return folder / kProgram;
    throw Error(ErrorCode::internal, "the decoder program is missing", (self.parent_path() / kProgram).string(),
                "install VICON again");
}

/// Starts the program with `socket` as its standard input; no other descriptor and nothing of the environment is
/// handed on, but what a sanitizer or a library's place needs.
pid_t start(const fs::path& program, int socket)
{
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    std::string name = kProgram;
    std::array<char*, 2> arguments{name.data(), nullptr};
    std::vector<char*> environment;
    for (char** variable = environ; *variable; ++variable)
        for (const char* kept : {"LD_LIBRARY_PATH=", "ASAN_OPTIONS=", "UBSAN_OPTIONS=", "DCMDICTPATH="})
            if (std::strncmp(*variable, kept, std::strlen(kept)) == 0)
                environment.push_back(*variable);
    environment.push_back(nullptr);
    pid_t process = -1;
    const int failure =
        ::posix_spawn(&process, program.c_str(), &actions, nullptr, arguments.data(), environment.data());
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        throw Error(ErrorCode::internal,
                    "the decoder program cannot be started (" + std::string(std::strerror(failure)) + ")",
                    program.string(), "see whether memory or processes are short");
    return process;
}

}  // namespace

HelperProcess::HelperProcess()
{
    const fs::path program = findProgram();
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw Error(ErrorCode::internal, "no socket for the decoder program", std::strerror(errno),
                    "see whether descriptors are short");
    try {
        process_ = start(program, ends[1]);
    } catch (...) {
        ::close(ends[0]);
        ::close(ends[1]);
        throw;
    }
    ::close(ends[1]);
    socket_ = ends[0];
    ::fcntl(socket_, F_SETFL, O_NONBLOCK);
}

HelperProcess::~HelperProcess()
{
    if (socket_ >= 0)
        ::close(socket_);
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

void HelperProcess::died()
{
    if (process_ <= 0)
        throw HelperDied("ended", false);
    int status = 0;
    ::kill(process_, SIGKILL);  // no effect on one that has ended by itself
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGPROF || signal == SIGXCPU)
        throw HelperDied("took too long", true);
    if (WIFEXITED(status) && WEXITSTATUS(status) == kNotConfined)
        throw Error(ErrorCode::internal, "the decoder program cannot be confined, and decodes nothing", kProgram,
                    "let this system filter system calls (seccomp)");
    throw HelperDied(signal ? "ended by signal " + std::to_string(signal) : "ended", false);
}

void HelperProcess::waitFor(short events, Clock::time_point until)
{
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
        if (left <= 0)
            throw HelperDied("took too long", true);
        pollfd waiting{socket_, events, 0};
        const int ready = ::poll(&waiting, 1, int(left));
        if (ready > 0)
            return;
        if (ready < 0 && errno != EINTR)
            died();
    }
}

void HelperProcess::send(const HelperRequest& request, std::string_view payload, int descriptor,
                         Clock::time_point until)
{
    msghdr message{};
    iovec part{const_cast<HelperRequest*>(&request), sizeof request};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    if (descriptor >= 0) {
        message.msg_control = control.data();
        message.msg_controllen = control.size();
        cmsghdr* const header = CMSG_FIRSTHDR(&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
    }
    waitFor(POLLOUT, until);
    if (::sendmsg(socket_, &message, MSG_NOSIGNAL) != ssize_t(sizeof request))
        died();
    while (!payload.empty()) {
        waitFor(POLLOUT, until);
        const ssize_t count = ::send(socket_, payload.data(), payload.size(), MSG_NOSIGNAL);
        if (count > 0)
            payload.remove_prefix(std::size_t(count));
        else if (errno != EAGAIN && errno != EINTR)
            died();
    }
}

void HelperProcess::receive(char* to, std::size_t count, Clock::time_point until)
{
    while (count > 0) {
        waitFor(POLLIN, until);
        const ssize_t some = ::recv(socket_, to, count, 0);
        if (some == 0 || (some < 0 && errno != EAGAIN && errno != EINTR))
            died();
        if (some > 0) {
            to += some;
            count -= std::size_t(some);
        }
    }
}

std::vector<char> HelperProcess::ask(const HelperRequest& request, std::string_view payload, int descriptor,
                                     std::size_t most_bytes)
{
    const auto until = Clock::now() + std::chrono::seconds(request.cpu_seconds * kPatience);
    send(request, payload, descriptor, until);
    HelperAnswer answer;
    receive(reinterpret_cast<char*>(&answer), sizeof answer, until);
    const bool done = answer.fate == HelperAnswer::Fate::done;
    if (answer.bytes > (done ? most_bytes : kLongestReason))
        throw HelperDied("answered nonsense", false);
    std::vector<char> bytes(answer.bytes);
    receive(bytes.data(), bytes.size(), until);
    if (!done)
        throw Error(ErrorCode::bad_input, std::string(bytes.begin(), bytes.end()));
    return bytes;
}

}  // namespace vicon::ingest

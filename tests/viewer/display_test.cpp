#include "vicon/viewer/scene/display.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>
#include <string>
#include <thread>
#include <vector>

#include "vicon/support/support.h"

namespace vicon::viewer {
namespace {

// The probe as a child process whose output and input are ours.
class Probe {
public:
    explicit Probe(const std::vector<std::string>& environment)
    {
        int in[2], out[2];
        if (::pipe(in) != 0 || ::pipe(out) != 0)
            throw std::runtime_error("no pipe");
        pid_ = ::fork();
        if (pid_ == 0) {
            ::dup2(in[0], 0);
            ::dup2(out[1], 1);
            for (const int fd : {in[0], in[1], out[0], out[1]})
                ::close(fd);
            std::vector<char*> variables;
            for (const std::string& variable : environment)
                variables.push_back(const_cast<char*>(variable.c_str()));
            variables.push_back(nullptr);
            char* arguments[] = {const_cast<char*>(VICON_DISPLAY_PROBE), nullptr};
            ::execve(VICON_DISPLAY_PROBE, arguments, variables.data());
            ::_exit(126);
        }
        ::close(in[0]);
        ::close(out[1]);
        in_ = in[1];
        out_ = out[0];
        ::fcntl(in_, F_SETFD, FD_CLOEXEC);
        ::fcntl(out_, F_SETFD, FD_CLOEXEC);
    }
    ~Probe()
    {
        end(SIGKILL);
        ::close(out_);
    }
    Probe(const Probe&) = delete;
    Probe& operator=(const Probe&) = delete;

    std::string line() const
    {
        std::string text;
        for (char c = 0; ::read(out_, &c, 1) == 1 && c != '\n';)
            text += c;
        return text;
    }
    // Lets it end by itself, or kills it; its exit code, or -1 when killed.
    int end(int signal = 0)
    {
        if (pid_ <= 0)
            return -1;
        if (signal != 0)
            ::kill(pid_, signal);
        ::close(in_);
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

private:
    pid_t pid_ = 0;
    int in_ = -1, out_ = -1;
};

bool listens(const std::string& display)
{
    const std::string name = "/tmp/.X11-unix/X" + display.substr(1);
    const int fd = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof address.sun_path - 1);
    const bool connected = ::connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    ::close(fd);
    return connected;
}

bool isGoneSoon(const std::string& display)
{
    return support::waitUntil([&] { return !listens(display); });
}

const std::vector<std::string> kNoDisplay{"PATH=/usr/bin:/bin"};

TEST(Display, SeveralProcessesEachHaveTheirOwnAndEndIt)
{
    std::vector<std::unique_ptr<Probe>> probes;
    for (int n = 0; n < 4; ++n)
        probes.push_back(std::make_unique<Probe>(kNoDisplay));
    std::set<std::string> names;
    for (const auto& probe : probes)
        names.insert(probe->line());
    EXPECT_EQ(names.size(), probes.size());
    for (const std::string& name : names)
        EXPECT_TRUE(listens(name)) << name;
    for (const auto& probe : probes)
        EXPECT_EQ(probe->end(), 0);
    for (const std::string& name : names)
        EXPECT_TRUE(isGoneSoon(name)) << name;
}

TEST(Display, ThePrivateServerDiesWithAKilledProcess)
{
    Probe probe(kNoDisplay);
    const std::string name = probe.line();
    ASSERT_TRUE(listens(name)) << name;
    probe.end(SIGKILL);
    EXPECT_TRUE(isGoneSoon(name)) << name;
}

TEST(Display, AnAnsweringDisplayIsUsedAndADeadOneIsNot)
{
    const Display display;
    const char* authority = std::getenv("XAUTHORITY");
    Probe guest(
        {"PATH=/usr/bin:/bin", "DISPLAY=" + display.name(), "XAUTHORITY=" + std::string(authority ? authority : "")});
    EXPECT_EQ(guest.line(), display.name());
    Probe lost({"PATH=/usr/bin:/bin", "DISPLAY=:9753"});
    EXPECT_NE(lost.line(), ":9753");
}

TEST(Display, SoftwareOpenGlHasTwoThreadsACoreUnlessToldOtherwise)
{
    constexpr const char* kThreads = "LP_NUM_THREADS";
    ::setenv(kThreads, "3", 1);
    {
        const Display display;
        EXPECT_STREQ(std::getenv(kThreads), "3");
    }
    ::unsetenv(kThreads);
    const Display display;
    ASSERT_TRUE(std::getenv(kThreads));
    EXPECT_EQ(std::stoul(std::getenv(kThreads)), 2 * std::thread::hardware_concurrency());
}

TEST(Display, OneServerServesAllObjectsOfAProcess)
{
    const Display a, b;
    EXPECT_EQ(a.name(), b.name());
    EXPECT_EQ(a.name(), std::getenv("DISPLAY"));
}

}  // namespace
}  // namespace vicon::viewer

#include "child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>

namespace vicon::bench {
namespace {

/// Of a process with all its threads; see proc(5).
Sample sampleOf(pid_t pid, double at_s)
{
    Sample sample{.at_s = at_s};
    const std::string folder = "/proc/" + std::to_string(pid);
    std::ifstream statm(folder + "/statm");
    long all = 0, resident = 0;
    statm >> all >> resident;
    sample.resident_mb = double(resident) * double(::sysconf(_SC_PAGESIZE)) / 1e6;
    std::ifstream stat(folder + "/stat");
    std::string line;
    std::getline(stat, line);
    std::istringstream rest(line.substr(std::min(line.size(), line.rfind(')') + 1)));
    std::string word;
    for (int field = 3; field < 14; ++field)
        rest >> word;
    double user = 0, system = 0;
    rest >> user >> system;
    sample.cpu_s = (user + system) / double(::sysconf(_SC_CLK_TCK));
    return sample;
}

double secondsOf(const timeval& t)
{
    return double(t.tv_sec) + double(t.tv_usec) / 1e6;
}

}  // namespace

Usage runToEnd(const std::vector<std::string>& command, const std::string& output_file)
{
    const auto start = std::chrono::steady_clock::now();
    const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
    const pid_t pid = ::fork();
    if (pid == 0) {
        const int out = ::open(output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(out, STDOUT_FILENO);
        ::dup2(out, STDERR_FILENO);
        std::vector<char*> arguments;
        for (const std::string& word : command)
            arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
    }
    Usage usage;
    int status = 0;
    rusage used{};
    while (::wait4(pid, &status, WNOHANG, &used) == 0) {
        usage.samples.push_back(sampleOf(pid, passed()));
        ::usleep(10000);
    }
    usage.wall_s = passed();
    usage.cpu_s = secondsOf(used.ru_utime) + secondsOf(used.ru_stime);
    usage.peak_mb = double(used.ru_maxrss) * 1024 / 1e6;
    usage.samples.push_back({usage.wall_s, usage.cpu_s, 0});
    usage.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    return usage;
}

}  // namespace vicon::bench

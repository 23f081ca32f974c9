#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "study.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

const int kKills = inFull() ? 50 : 3;

std::string importAndWork(const fs::path& store)
{
    const std::string vicon = viconBinary();
    return vicon + " import " + smallStudy().string() + " --store " + store.string() + " >/dev/null 2>&1 && exec " +
           vicon + " work --until-idle --store " + store.string() + " >/dev/null 2>&1";
}

/// Runs a shell line in a process group of its own and kills the whole group after `seconds`. True when it was still
/// running.
bool killAfter(double seconds, const std::string& shell_line)
{
    const pid_t child = ::fork();
    if (child == 0) {
        ::setpgid(0, 0);
        ::execl("/bin/sh", "sh", "-c", shell_line.c_str(), nullptr);
        ::_exit(127);
    }
    // The moment of the kill is what is tried.
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    const bool running = ::waitpid(child, nullptr, WNOHANG) == 0;
    ::kill(-child, SIGKILL);
    if (running)
        ::waitpid(child, nullptr, 0);
    return running;
}

void expectSame(const std::map<std::string, std::string>& got, const std::map<std::string, std::string>& expected)
{
    for (const auto& [file, content] : expected) {
        const auto found = got.find(file);
        ASSERT_NE(found, got.end()) << file << " is missing";
        EXPECT_TRUE(found->second == content) << file << " differs";
    }
    for (const auto& [file, content] : got)
        EXPECT_TRUE(expected.contains(file)) << file << " should not be there";
}

TEST(Kill, AtAnyMomentOfImportAndWorkLosesNothing)
{
    const TemporaryFolder undisturbed;
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(runCommand(importAndWork(undisturbed.path())).exit_code, 0);
    double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto expected = filesOf(undisturbed.path());
    ASSERT_TRUE(std::any_of(expected.begin(), expected.end(), [](const auto& entry) {
        return entry.first.ends_with("cells.vtp");
    })) << "the undisturbed run must have come to its end";

    std::mt19937 random(20261121);
    int killed = 0;
    for (int n = 0; n < kKills; ++n) {
        const TemporaryFolder store;
        // One moment in each n-th part of the whole run, so that few kills still meet different work.
        const double moment_s = whole_s * (n + std::uniform_real_distribution<>(0, 1)(random)) / kKills;
        SCOPED_TRACE("killed after " + std::to_string(moment_s) + " s of " + std::to_string(whole_s) + " s");
        if (killAfter(moment_s, importAndWork(store.path())))
            ++killed;
        else
            whole_s = moment_s;  // at its end by then: the machine has more time for it than for the first run
        viconOn(store.path(), "import " + smallStudy().string());
        viconOn(store.path(), "work --until-idle");
        expectSame(filesOf(store.path()), expected);
    }
    EXPECT_GT(killed, kKills / 2) << "most kills must meet work";
    std::printf("%d of %d runs were killed while at work\n", killed, kKills);
}

}  // namespace
}  // namespace vicon::support

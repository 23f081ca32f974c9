// Killed at any moment between the command and its last file, a report is either a draft or signed with all that
// belongs to it.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "study.h"
#include "vicon/core/file.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

const int kKills = inFull() ? 200 : 8;

class SignKill : public testing::Test {
protected:
    TemporaryFolder folder_;
    fs::path store_ = folder_ / "store";
    std::string case_id_;

    SignKill()
    {
        replaceFile(folder_ / "c.toml", "[roles]\nsign = [\"" + account() + "\"]\n[report]\nsend_to = [\"pacs\"]\n" +
                                            "[peers]\npacs = { host = \"127.0.0.1\", port = 9 }\n");
        viconOn(store_, "import " + smallStudy().string());
        viconOn(store_, "work --until-idle");
        case_id_ = listedScans(store_).at(0).case_id;
        viconOn(store_, "assess " + case_id_ + " --c-rads C1 --why test --e-rads E1 --e-why test");
    }
    static std::string account()
    {
        std::string name = runCommand("id -un").output;
        name.erase(name.find_last_not_of('\n') + 1);
        return name;
    }
    std::vector<std::string> signing() const
    {
        return {viconBinary(), "sign", case_id_, "--store", store_.string(), "--config", (folder_ / "c.toml").string()};
    }
    /// True when it was killed while at work.
    bool signAndKillAfter(double seconds) const
    {
        const pid_t child = ::fork();
        if (child == 0) {
            std::vector<std::string> words = signing();
            std::vector<char*> arguments;
            for (std::string& word : words)
                arguments.push_back(word.data());
            arguments.push_back(nullptr);
            ::setpgid(0, 0);
            if (!::freopen("/dev/null", "w", stdout) || !::freopen("/dev/null", "w", stderr))
                ::_exit(127);
            ::execv(arguments[0], arguments.data());
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
    nlohmann::json audit() const { return viconJson(store_, "audit " + case_id_); }
    /// The last that happened to the report, not to what was queued of it.
    static std::string lastEvent(const nlohmann::json& trail)
    {
        std::string last;
        for (const auto& entry : trail)
            if (const std::string event = entry["event"];
                event.find("report") != event.npos || event.find("amend") != event.npos)
                last = event;
        return last;
    }
    /// What waits for the peer and lies in the report's folder as it was queued.
    std::size_t wholeObjects() const
    {
        std::size_t count = 0;
        const nlohmann::json outbox = viconJson(store_, "outbox " + case_id_);
        for (const auto& item : outbox["items"])
            count += sha256OfFile(store_ / item["file"].get<std::string>()) == item["sha256"];
        return count;
    }
};

TEST_F(SignKill, LeavesADraftOrASignedReport)
{
    viconOn(store_, "sign " + case_id_ + " --config " + (folder_ / "c.toml").string());
    const std::size_t of_one_version = wholeObjects();
    ASSERT_EQ(of_one_version, 3u) << "PDF, measurements and lumen";
    viconOn(store_, "amend " + case_id_ + " --reason again --config " + (folder_ / "c.toml").string());
    const auto start = std::chrono::steady_clock::now();  // of the second one: the first one takes longer
    viconOn(store_, "sign " + case_id_ + " --config " + (folder_ / "c.toml").string());
    const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::mt19937 random(20261123);
    std::size_t versions = 2;
    int killed = 0, completed = 0;
    bool open = false;
    for (int n = 0; n < kKills; ++n) {
        if (!open)
            viconOn(store_, "amend " + case_id_ + " --reason again --config " + (folder_ / "c.toml").string());
        // Most kills late: that is when it is written.
        const double part = std::uniform_real_distribution<>(n % 4 == 0 ? 0 : 0.6, 1.05)(random);
        killed += signAndKillAfter(whole_s * part);
        const auto found = audit();  // exit code 0: every version is as it was kept
        const std::size_t now = found["versions"].size();
        ASSERT_TRUE(now == versions || now == versions + 1) << now;
        open = now == versions;
        completed += !open;
        versions = now;
        EXPECT_EQ(wholeObjects(), of_one_version * versions) << "those of each version, and none besides";
        EXPECT_EQ(lastEvent(found["trail"]), open ? "amendment begun" : "report amended");
    }
    EXPECT_GT(killed, 0);
    viconOn(store_, open ? "sign " + case_id_ + " --config " + (folder_ / "c.toml").string() : "cases");
    std::printf("%d of %d were killed while at work, %d had signed\n", killed, kKills, completed);
}

}  // namespace
}  // namespace vicon::support

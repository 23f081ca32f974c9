#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <random>

#include "vicon/cases/case_store.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

using nlohmann::json;

namespace vicon::viewer {
namespace {

constexpr double kLongest_s = 0.4;  // that a reader works before it is killed
const int kKills = support::inFull() ? 50 : 3;
constexpr int kPatience_ms = 60'000;

/// A marker_worker in a process of its own.
class Reader {
public:
    Reader(const std::filesystem::path& store, const std::string& name, unsigned seed)
    {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0)
            throw std::runtime_error("no pipe");
        child_ = ::fork();
        if (child_ == 0) {
            ::dup2(ends[1], STDOUT_FILENO);
            ::execl(VICON_MARKER_WORKER, "marker_worker", store.c_str(), "c1", name.c_str(),
                    std::to_string(seed).c_str(), nullptr);
            ::_exit(127);
        }
        ::close(ends[1]);
        out_ = ends[0];
    }
    ~Reader()
    {
        kill();
        ::close(out_);
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// True when it still ran.
    bool kill()
    {
        if (child_ <= 0)
            return false;
        ::kill(child_, SIGKILL);
        int status = 0;
        ::waitpid(std::exchange(child_, -1), &status, 0);
        while (readSome(0)) {
        }
        return WIFSIGNALED(status);
    }
    /// False at the end of its output, or when nothing comes.
    bool readSome(int wait_ms)
    {
        pollfd ready{out_, POLLIN, 0};
        if (::poll(&ready, 1, wait_ms) <= 0)
            return false;
        char bytes[4096];
        const auto count = ::read(out_, bytes, sizeof bytes);
        if (count > 0)
            said_.append(bytes, std::size_t(count));
        return count > 0;
    }
    const std::string& said() const { return said_; }

private:
    pid_t child_ = -1;
    int out_ = -1;
    std::string said_;
};

/// What a reader was told: the last reported content of each marker, null for a deleted one.
struct Told {
    std::map<std::string, json> have;
    std::map<std::string, json> want;  // under way when it was killed; "" is a new one
    int saved = 0;

    void hear(const std::string& said)
    {
        want.clear();
        for (std::size_t at = 0, end = 0; (end = said.find('\n', at)) != std::string::npos; at = end + 1) {
            std::map<std::string, json> list;
            for (const auto& entry : json::parse(said.substr(at + 5, end - at - 5)))
                list[entry[0]] = entry[1];
            if (said.compare(at, 4, "want") == 0)
                want = list;
            else
                report(list);
        }
    }

private:
    void report(const std::map<std::string, json>& list)
    {
        ++saved;
        if (want.contains(""))
            EXPECT_EQ(list.begin()->second, want.at(""));
        else
            EXPECT_EQ(list, want) << "what is shown after a change is what was asked for";
        for (const auto& [id, content] : list)
            have[id] = content;
        want.clear();
    }
};

class MarkerKill : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    std::mt19937 random_{20261121};
    int killed_ = 0;

    MarkerKill()
    {
        CaseStore store(folder_.path());
        CaseRecord a_case;
        a_case.id = "c1";
        a_case.study.uid = "1.2";
        for (const std::string id : {"s1", "s2"}) {
            std::filesystem::create_directories(store.scanFolder("c1", id));
            ScanRecord scan;
            scan.id = id;
            scan.case_id = "c1";
            scan.series.uid = "1.2." + id;
            store.addScan(a_case, scan, {}, false);
        }
    }

    void workAndKill(std::map<std::string, Told>& readers)
    {
        std::vector<std::unique_ptr<Reader>> at_work;
        for (const auto& [name, told] : readers)
            at_work.push_back(std::make_unique<Reader>(folder_.path(), name, unsigned(random_())));
        for (const auto& reader : at_work)
            EXPECT_TRUE(reader->readSome(kPatience_ms)) << "a reader did not begin";
        for (const auto& reader : at_work) {
            const auto moment = std::chrono::steady_clock::now() +
                                std::chrono::duration<double>(std::uniform_real_distribution<>(0, kLongest_s)(random_));
            while (std::chrono::steady_clock::now() < moment)
                for (const auto& any : at_work)
                    any->readSome(1);
            killed_ += reader->kill();
        }
        std::size_t n = 0;
        for (auto& [name, told] : readers)
            told.hear(at_work[n++]->said());
    }

    std::map<std::string, json> stored()
    {
        CaseStore store(folder_.path());
        std::map<std::string, json> all;
        json list = json::array();
        for (const Marker& marker : store.markers("c1")) {
            json content = toJson(marker);
            list.push_back(content);
            for (const char* key : {"id", "created", "changed"})
                content.erase(key);
            EXPECT_TRUE(all.emplace(marker.id, content).second) << marker.id << " is there twice";
        }
        EXPECT_EQ(json::parse(readFile(store.caseFolder("c1") / "markers.json"))["markers"], list)
            << "the file is right again after opening";
        return all;
    }

    /// Takes what is `told` out of `all`, so that what nobody knows of remains.
    static void expectKept(Told& told, const std::string& name, std::map<std::string, json>& all)
    {
        const auto take = [&](const std::string& id) {
            const auto node = all.extract(id);
            return node.empty() ? json() : node.mapped();
        };
        std::map<std::string, json> now, before;
        for (const auto& [id, content] : told.have) {
            const json found = take(id);
            if (told.want.contains(id)) {
                now[id] = found;
                before[id] = content;
            } else {
                EXPECT_EQ(found, content) << id << " was shown to " << name;
            }
            told.have[id] = found;
        }
        if (told.want.contains("")) {
            for (auto& [id, content] : std::map(all))
                if (content == told.want.at(""))
                    told.have[id] = take(id);
            return;
        }
        EXPECT_TRUE(now == before || now == told.want) << "a half step: " << json(now) << "\n  of " << json(told.want);
    }

    void killAgainAndAgain(std::map<std::string, Told> readers, int times)
    {
        for (int n = 0; n < times; ++n) {
            SCOPED_TRACE("round " + std::to_string(n));
            workAndKill(readers);
            auto all = stored();
            for (auto& [name, told] : readers)
                expectKept(told, name, all);
            EXPECT_TRUE(all.empty()) << "nobody asked for " << json(all);
            if (HasFailure())
                return;
        }
        int saved = 0;
        for (const auto& [name, told] : readers)
            saved += told.saved;
        EXPECT_EQ(killed_, times * int(readers.size())) << "every kill must meet a reader at work";
        EXPECT_GT(saved, times) << "there must have been something to lose";
        std::printf("%d kills, %d changes reported as saved, none lost\n", killed_, saved);
    }
};

TEST_F(MarkerKill, AtAnyMomentLosesNoMarkerThatWasShownAsSaved)
{
    killAgainAndAgain({{"anna", {}}}, kKills);
}

TEST_F(MarkerKill, OfTwoReadersAtOnceLosesNoMarkerOfEither)
{
    killAgainAndAgain({{"anna", {}}, {"bert", {}}}, kKills);
}

}  // namespace
}  // namespace vicon::viewer

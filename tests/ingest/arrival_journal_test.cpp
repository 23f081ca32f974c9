// What was received survives a power cut, though its own file was not flushed.
#include "arrival_journal.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <thread>

#include "vicon/core/error.h"
#include "vicon/core/file.h"
#include "vicon/support/support.h"

namespace fs = std::filesystem;
using namespace vicon;

namespace {

class Arrivals : public testing::Test {
protected:
    support::TemporaryFolder folder_;
    const fs::path incoming_ = folder_ / "incoming", sender_ = incoming_ / "20260101-1-0";

    void SetUp() override { makePrivateFolder(sender_); }
    fs::path file(int n) const { return sender_ / (std::to_string(n) + ".dcm"); }
    static std::string content(int n, std::size_t bytes = 200'000)
    {
        std::string text;
        for (int block = 0; text.size() < bytes; ++block)
            text += sha256(std::to_string(n) + ' ' + std::to_string(block));
        return text;
    }
    void keep(ingest::ArrivalJournal& journal, int n, const std::string& bytes) const
    {
        const fs::path received = sender_ / (".vicon-tmp-" + std::to_string(n));
        std::ofstream(received, std::ios::binary) << bytes;
        journal.keep(received, file(n));
    }
    std::unique_ptr<ingest::ArrivalJournal> journal() const
    {
        return std::make_unique<ingest::ArrivalJournal>(incoming_,
                                                        [](const std::string& what) { ADD_FAILURE() << what; });
    }
    /// Runs in a process that is dead afterwards.
    void inProcessThatDies(const std::function<void(ingest::ArrivalJournal&)>& work) const
    {
        const pid_t child = ::fork();
        if (child == 0) {
            work(*journal().release());
            ::_exit(0);
        }
        int status = -1;
        ::waitpid(child, &status, 0);
        ASSERT_EQ(status, 0);
    }
    /// Of two files that were not flushed, one has lost its bytes, and one its name too.
    void cutPower(int first = 0, int second = 1) const
    {
        fs::resize_file(file(first), 0);
        fs::remove(file(second));
    }
    std::vector<fs::path> journalFiles() const
    {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(incoming_))
            if (entry.is_regular_file())
                files.push_back(entry.path());
        return files;
    }
    /// The one part that was written.
    fs::path part() const
    {
        EXPECT_EQ(journalFiles().size(), 1u);
        return journalFiles().at(0);
    }
};

TEST_F(Arrivals, LieUnderTheirNameAndNothingIsLeftOfTheJournal)
{
    {
        const auto all = journal();
        keep(*all, 0, content(0));
        EXPECT_EQ(readFile(file(0)), content(0));
        EXPECT_FALSE(fs::exists(sender_ / ".vicon-tmp-0"));
        EXPECT_EQ(fs::status(file(0)).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    }
    EXPECT_TRUE(journalFiles().empty());
    EXPECT_EQ(readFile(file(0)), content(0));
}

TEST_F(Arrivals, ThatThePowerCutTookAreBack)
{
    inProcessThatDies([&](auto& dying) {
        for (const int n : {0, 1, 2})
            keep(dying, n, content(n));
    });
    cutPower();
    fs::remove_all(sender_);
    const auto next = journal();
    for (const int n : {0, 1, 2})
        EXPECT_EQ(readFile(file(n)), content(n));
    EXPECT_TRUE(journalFiles().empty());
}

TEST_F(Arrivals, ThatDidNotComeWholeIntoTheJournalAreNotPutBack)
{
    inProcessThatDies([&](auto& dying) {
        for (const int n : {0, 1, 2})
            keep(dying, n, content(n));
    });
    std::string bytes = readFile(part());
    const std::size_t in_second = bytes.find(content(1).substr(0, 64));
    ASSERT_NE(in_second, std::string::npos);
    bytes[in_second + 100'000] ^= 1;
    std::ofstream(part(), std::ios::binary) << bytes;
    cutPower();
    const auto next = journal();
    EXPECT_EQ(readFile(file(0)), content(0));
    EXPECT_FALSE(fs::exists(file(1)));
    EXPECT_EQ(readFile(file(2)), content(2));
}

TEST_F(Arrivals, ThatWereTakenAwayAfterTheyWereSettledStayAway)
{
    inProcessThatDies([&](auto& dying) {
        keep(dying, 0, content(0));
        dying.settle();
        fs::remove(file(0));
        keep(dying, 1, content(1));
        keep(dying, 2, content(2));
    });
    for (const fs::path& part : journalFiles())
        EXPECT_EQ(readFile(part).find(content(0).substr(0, 64)), std::string::npos);
    cutPower(2, 1);
    const auto next = journal();
    EXPECT_FALSE(fs::exists(file(0)));
    EXPECT_EQ(readFile(file(1)), content(1));
    EXPECT_EQ(readFile(file(2)), content(2));
}

/// What a peer sends may look like a head of the journal, with a name that leads elsewhere.
TEST_F(Arrivals, CannotPutAnythingElsewhere)
{
    const fs::path elsewhere = folder_ / "elsewhere";
    inProcessThatDies([&](auto& dying) { keep(dying, 0, content(0)); });
    std::string bytes = readFile(part());
    constexpr std::size_t kHead = 4096;
    const std::size_t name = bytes.find("20260101-1-0/0.dcm");
    ASSERT_NE(name, std::string::npos);
    std::string with_key = bytes;
    with_key.replace(name, 18, "../elsewhere/0.dcm");
    std::ofstream(part(), std::ios::binary) << with_key;
    journal();
    EXPECT_FALSE(fs::exists(elsewhere));

    const std::string copy = bytes.substr(kHead, kHead + content(0).size());
    inProcessThatDies([&](auto& dying) {
        keep(dying, 1, copy);  // a copy of another key
        fs::remove(file(0));
    });
    bytes = readFile(part());
    bytes.replace(kHead, kHead, kHead, '\0');  // that copy's own head never came
    std::ofstream(part(), std::ios::binary) << bytes;
    journal();
    EXPECT_FALSE(fs::exists(file(0)));
}

TEST_F(Arrivals, OfManyAtOnceFillNoMoreThanTwoParts)
{
    constexpr int kThreads = 4, kEach = 20;
    constexpr std::size_t kBytes = 1'000'000;
    constexpr std::uintmax_t kMostBytes = 16U << 20U;
    const std::string bytes = content(7, kBytes);
    inProcessThatDies([&](auto& dying) {
        std::vector<std::thread> threads;
        for (int t = 0; t < kThreads; ++t)
            threads.emplace_back([&, t] {
                for (int n = 0; n < kEach; ++n)
                    keep(dying, t * kEach + n, bytes + std::to_string(t * kEach + n));
            });
        for (std::thread& thread : threads)
            thread.join();
    });
    EXPECT_EQ(journalFiles().size(), 2u);
    for (const fs::path& part : journalFiles())
        EXPECT_LE(fs::file_size(part), kMostBytes);
    cutPower(kThreads * kEach - 1, kThreads * kEach - 1);
    const auto next = journal();
    for (int n = 0; n < kThreads * kEach - 1; ++n)
        EXPECT_EQ(readFile(file(n)), bytes + std::to_string(n));
}

TEST_F(Arrivals, ThatAreTooLargeForTheJournalAreKeptWithoutIt)
{
    const std::string large = content(0, 6'000'000);
    inProcessThatDies([&](auto& dying) { keep(dying, 0, large); });
    EXPECT_EQ(readFile(file(0)), large);
    EXPECT_TRUE(journalFiles().empty());
}

TEST_F(Arrivals, AreKeptWhereTheJournalCannotBeWritten)
{
    const auto all = journal();
    fs::create_directories(incoming_ / "arrivals-1.journal");
    fs::create_directories(incoming_ / "arrivals-2.journal");
    keep(*all, 0, content(0));
    all->settle();
    EXPECT_EQ(readFile(file(0)), content(0));
}

TEST_F(Arrivals, ThatCannotBeKeptAreSaid)
{
    const auto all = journal();
    EXPECT_THROW(all->keep(sender_ / "never-came", file(0)), std::exception);
    fs::remove_all(incoming_);
    EXPECT_THROW(keep(*all, 1, content(1)), std::exception);
}

}  // namespace

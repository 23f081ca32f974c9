#include "vicon/cases/job_queue.h"

#include <gmock/gmock.h>
#include <soci/soci.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>
#include <thread>

#include "fake_jobs.h"
#include "vicon/core/error.h"

namespace vicon::pipeline {
namespace {

using testing::HasSubstr;

class Queue : public testing::Test {
protected:
    double now_ = 1000;
    FakeStore fake_;
    JobQueue queue_{fake_.store.database(), QueueOptions{.lease_s = 10, .most_attempts = 3, .most_drops = 4},
                    [this] { return now_; }};

    ErrorCode codeOf(const std::function<void()>& action)
    {
        try {
            action();
        } catch (const Error& e) {
            return e.code();
        }
        ADD_FAILURE() << "nothing was thrown";
        return ErrorCode::internal;
    }
};

TEST_F(Queue, GivesJobsInTheOrderTheyCameAndEachOnce)
{
    fake_.addJobs(3);
    EXPECT_EQ(queue_.claim("a")->scan_id, "s0");
    EXPECT_EQ(queue_.claim("b")->scan_id, "s1");
    EXPECT_EQ(queue_.claim("c")->scan_id, "s2");
    EXPECT_FALSE(queue_.claim("d"));
}

TEST_F(Queue, GivesWhatAReaderOpenedFirstAndThatOfTheLastOpenedBeforeAll)
{
    fake_.addJobs(2);
    for (const std::string id : {"d", "e"}) {
        std::filesystem::create_directories(fake_.store.scanFolder(id, "s0"));
        fake_.store.addScan({.id = id, .study = {.uid = id}}, {.id = "s0", .case_id = id}, {}, true);
    }
    queue_.putFirst("d");
    now_ += 1;
    queue_.putFirst("e");
    EXPECT_EQ(queue_.claim("a")->case_id, "e");
    queue_.fail(*queue_.find("e", "s0"), "busy", false);
    EXPECT_EQ(queue_.claim("a")->case_id, "d");
    EXPECT_EQ(queue_.claim("a")->case_id, "c") << "what failed is held back all the same";
    now_ += 2;
    EXPECT_EQ(queue_.claim("a")->case_id, "e");
}

TEST_F(Queue, LetsSendersTakeTurnsSoThatNoneWaitsForAllThatAnotherSent)
{
    const auto send = [&](const std::string& sender, const std::string& id) {
        std::filesystem::create_directories(fake_.store.scanFolder(id, "s0"));
        const nlohmann::json ingest = {{kIngestSender, sender}};
        fake_.store.addScan({.id = id, .study = {.uid = id}}, {.id = "s0", .case_id = id, .ingest = ingest}, {}, true);
    };
    const auto next = [&] { return queue_.claim("a")->case_id; };
    for (int n = 0; n < 100; ++n)
        send("CT1", "a" + std::to_string(n));
    EXPECT_EQ(next(), "a0");
    EXPECT_EQ(next(), "a1");
    for (const char* id : {"b0", "b1", "b2"})
        send("CT2", id);
    std::vector<std::string> order;
    for (int n = 0; n < 6; ++n)
        order.push_back(next());
    EXPECT_THAT(order, testing::ElementsAre("a2", "b0", "a3", "b1", "a4", "b2"));
    send("CT3", "c0");
    send("CT2", "b3");
    EXPECT_EQ(next(), "a5");
    EXPECT_EQ(next(), "c0");
    EXPECT_EQ(next(), "b3");
    EXPECT_EQ(next(), "a6");
    queue_.putFirst("a99");
    EXPECT_EQ(next(), "a99") << "what a reader opened comes before all turns";
}

TEST_F(Queue, CountsAndListsJobsOfAState)
{
    fake_.addJobs(3);
    queue_.fail(*queue_.claim("a"), "not a CT", true);
    queue_.claim("a");
    EXPECT_EQ(queue_.count(JobState::queued), 1);
    EXPECT_EQ(queue_.count(JobState::running), 1);
    EXPECT_EQ(queue_.jobs(JobState::failed).at(0).scan_id, "s0");
    EXPECT_TRUE(queue_.jobs(JobState::done).empty());
}

TEST_F(Queue, GivesTheMemoryOfAMachineOnce)
{
    fake_.addJobs(4);
    constexpr double kMost_mb = 1000;
    const Job one = *queue_.claim("here/boot/1/1"), other = *queue_.claim("here/boot/2/1"),
              elsewhere = *queue_.claim("there/boot/3/1");
    EXPECT_TRUE(queue_.reserveMemory(one, 1500, kMost_mb)) << "alone it gets what it needs";
    EXPECT_FALSE(queue_.reserveMemory(other, 100, kMost_mb));
    EXPECT_TRUE(queue_.reserveMemory(elsewhere, 900, kMost_mb)) << "another machine has its own";
    EXPECT_TRUE(queue_.reserveMemory(one, 600, kMost_mb)) << "instead of what it had";
    EXPECT_TRUE(queue_.reserveMemory(other, 400, kMost_mb));
    EXPECT_FALSE(queue_.reserveMemory(*queue_.claim("here/boot/4/1"), 1, kMost_mb));
    queue_.complete(one);
    EXPECT_TRUE(queue_.reserveMemory(*queue_.find("c", "s3"), 600, kMost_mb)) << "what ended gave it back";
    EXPECT_EQ(codeOf([&] { queue_.reserveMemory(one, 1, kMost_mb); }), ErrorCode::lease_lost);
}

TEST_F(Queue, GivesEachJobToOneOfManyProcessesOnly)
{
    fake_.addJobs(40);
    std::vector<std::thread> threads;
    std::array<std::vector<std::string>, 4> taken;
    for (auto& mine : taken)
        threads.emplace_back([&] {
            Database database(fake_.store.database().where());
            JobQueue queue(database, queue_.options());
            while (const auto job = queue.claim("elsewhere/x/1/1"))
                mine.push_back(job->scan_id);
        });
    for (auto& thread : threads)
        thread.join();
    std::multiset<std::string> all;
    for (const auto& mine : taken)
        all.insert(mine.begin(), mine.end());
    EXPECT_EQ(all.size(), 40u);
    EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), 40u);
}

TEST_F(Queue, TakesNoWordFromAnotherThanTheOwnerOfAJob)
{
    fake_.addJobs(1);
    const Job job = *queue_.claim("a");
    Job with_the_same_fence = job;
    with_the_same_fence.owner = "b";
    EXPECT_EQ(codeOf([&] { queue_.renew(with_the_same_fence, "x", 0); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { queue_.complete(with_the_same_fence); }), ErrorCode::lease_lost);
    EXPECT_NO_THROW(queue_.complete(job));
}

TEST_F(Queue, TakesAJobFromAWorkerWhoseLeaseLapsed)
{
    fake_.addJobs(1);
    const Job lost = *queue_.claim("a");
    now_ += 11;
    const Job taken = *queue_.claim("b");
    EXPECT_EQ(taken.scan_id, lost.scan_id);
    EXPECT_GT(taken.fence, lost.fence);
    EXPECT_EQ(taken.attempts, 1) << "a claim dropped without an outcome is a failure";
    EXPECT_THAT(taken.reason, HasSubstr("stopped without a word"));
}

TEST_F(Queue, LetsARenewedLeaseLive)
{
    fake_.addJobs(1);
    const Job job = *queue_.claim("a");
    now_ += 9;
    queue_.renew(job, "segment", 0.5);
    now_ += 9;
    EXPECT_FALSE(queue_.claim("b"));
    EXPECT_EQ(queue_.find("c", "s0")->step, "segment");
    EXPECT_DOUBLE_EQ(queue_.find("c", "s0")->progress, 0.5);
}

TEST_F(Queue, RefusesEverythingFromAWorkerThatLostItsJob)
{
    fake_.addJobs(1);
    const Job stale = *queue_.claim("a");
    now_ += 11;
    const Job current = *queue_.claim("b");
    const StepRecord step{.step = "segment", .version = 1, .digest = "stale"};
    EXPECT_EQ(codeOf([&] { queue_.renew(stale, "x", 0); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { queue_.commitStep(stale, step); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { queue_.complete(stale); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { queue_.fail(stale, "x", false); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { queue_.release(stale); }), ErrorCode::lease_lost);
    EXPECT_TRUE(fake_.store.steps("c", "s0").empty());
    queue_.complete(current);
    EXPECT_EQ(queue_.find("c", "s0")->state, JobState::done);
}

TEST_F(Queue, BacksOffTwiceAsLongAfterEachFailureAndThenFails)
{
    fake_.addJobs(1);
    const auto failOnce = [&] { queue_.fail(*queue_.claim("a"), "disk full", false); };
    failOnce();
    EXPECT_FALSE(queue_.claim("a"));
    EXPECT_DOUBLE_EQ(*queue_.nextDue(), now_ + 1);
    now_ += 1;
    failOnce();
    EXPECT_DOUBLE_EQ(*queue_.nextDue(), now_ + 2);
    now_ += 2;
    failOnce();
    const Job job = *queue_.find("c", "s0");
    EXPECT_EQ(job.state, JobState::failed);
    EXPECT_EQ(job.reason, "disk full");
    EXPECT_FALSE(queue_.nextDue());
}

TEST_F(Queue, DoesNotTryAgainWhatCannotSucceed)
{
    fake_.addJobs(1);
    queue_.fail(*queue_.claim("a"), "not a CT", true);
    EXPECT_EQ(queue_.find("c", "s0")->state, JobState::failed);
}

TEST_F(Queue, FailsAJobThatKeepsKillingItsWorkers)
{
    fake_.addJobs(1);
    for (int n = 0; n < 4; ++n) {
        ASSERT_TRUE(queue_.claim("a")) << n;
        now_ += 11;
    }
    EXPECT_FALSE(queue_.claim("a"));
    EXPECT_EQ(queue_.find("c", "s0")->state, JobState::failed);
}

TEST_F(Queue, DoesNotCountWorkersThatDiedEachTimeFurtherOn)
{
    fake_.addJobs(1);
    for (int n = 0; n < 20; ++n) {
        const auto job = queue_.claim("a");
        ASSERT_TRUE(job) << n;
        queue_.renew(*job, "segment", 0.04 * n);
        now_ += 11;
    }
    EXPECT_TRUE(queue_.claim("a"));
}

TEST_F(Queue, AWorkerWhoseClockIsAheadHidesNoJob)
{
    fake_.addJobs(2);
    JobQueue ahead(fake_.store.database(), queue_.options(), [this] { return now_ + 3600; });
    ASSERT_TRUE(ahead.claim("a"));
    ahead.fail(*ahead.claim("a"), "busy", false);
    EXPECT_FALSE(queue_.claim("b"));
    now_ += queue_.options().lease_s + 1;
    EXPECT_TRUE(queue_.claim("b")) << "one lease later, by the clock of those who wait";
    now_ += queue_.options().longest_backoff_s;
    EXPECT_TRUE(queue_.claim("b"));
}

TEST_F(Queue, AClockThatIsSetBackAnHourHidesNoJob)
{
    fake_.addJobs(2);
    ASSERT_TRUE(queue_.claim("a"));
    queue_.fail(*queue_.claim("a"), "busy", false);
    now_ -= 3600;
    EXPECT_FALSE(queue_.claim("b"));
    now_ += queue_.options().lease_s + 1;
    EXPECT_TRUE(queue_.claim("b"));
    now_ += queue_.options().longest_backoff_s;
    EXPECT_TRUE(queue_.claim("b"));
}

TEST_F(Queue, TheDatabasesClockCounts)
{
    JobQueue queue(fake_.store.database(), queue_.options());
    double seconds = 0;
    fake_.store.database().session() << (support::usesPostgresql() ? "SELECT EXTRACT(EPOCH FROM now())"
                                                                   : "SELECT CAST(strftime('%s', 'now') AS REAL)"),
        soci::into(seconds);
    EXPECT_NEAR(queue.now(), seconds, 5);
}

TEST_F(Queue, PublishesUnderTheFenceAndNotForAWorkerThatLostItsJob)
{
    fake_.addJobs(1);
    const Job stale = *queue_.claim("a");
    now_ += 11;
    const Job current = *queue_.claim("b");
    bool published = false;
    const StepRecord step{.step = "segment", .version = 1, .digest = "d"};
    EXPECT_EQ(codeOf([&] { queue_.commitStep(stale, step, [&] { published = true; }); }), ErrorCode::lease_lost);
    EXPECT_EQ(codeOf([&] { queue_.withdrawSteps(stale, {"segment"}, [&] { published = true; }); }),
              ErrorCode::lease_lost);
    EXPECT_FALSE(published);
    queue_.commitStep(current, step, [&] { published = true; });
    EXPECT_TRUE(published);
    bool removed = false;
    queue_.withdrawSteps(current, {"skeleton", "segment"}, [&] { removed = true; });
    EXPECT_TRUE(removed);
    EXPECT_TRUE(fake_.store.steps(current.case_id, current.scan_id).empty());
}

TEST_F(Queue, ForgetsFailuresWhenAStepWasFinished)
{
    fake_.addJobs(1);
    for (int n = 0; n < 10; ++n) {
        const auto job = queue_.claim("a");
        ASSERT_TRUE(job) << n;
        queue_.commitStep(*job, {.step = "step" + std::to_string(n), .version = 1, .digest = "d"});
        now_ += 11;
    }
    EXPECT_EQ(fake_.store.steps("c", "s0").size(), 10u);
}

TEST_F(Queue, RetriesByHandAFailedJobOnly)
{
    fake_.addJobs(1);
    queue_.fail(*queue_.claim("a"), "not a CT", true);
    queue_.retry("c", "s0");
    EXPECT_EQ(queue_.claim("a")->attempts, 0);
    EXPECT_EQ(codeOf([&] { queue_.retry("c", "other"); }), ErrorCode::not_found);
}

TEST_F(Queue, ReleasesAJobUntouchedWhenTheWorkerIsToldToStop)
{
    fake_.addJobs(1);
    queue_.release(*queue_.claim("a"));
    const auto job = queue_.claim("b");
    ASSERT_TRUE(job);
    EXPECT_EQ(job->attempts, 0);
}

TEST_F(Queue, TakesTheJobOfADeadProcessOfThisMachineAtOnce)
{
    fake_.addJobs(1);
    int owner_pipe[2];
    ASSERT_EQ(::pipe(owner_pipe), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const std::string owner = thisOwner();
        [[maybe_unused]] const auto written = ::write(owner_pipe[1], owner.data(), owner.size());
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    std::array<char, 512> text{};
    const auto size = ::read(owner_pipe[0], text.data(), text.size());
    ASSERT_GT(size, 0);
    ASSERT_TRUE(queue_.claim(std::string(text.data(), std::size_t(size))));
    EXPECT_TRUE(queue_.claim("b")) << "its lease has not lapsed, but the process is gone";
}

TEST_F(Queue, LeavesTheJobOfALivingProcessAlone)
{
    fake_.addJobs(1);
    ASSERT_TRUE(queue_.claim(thisOwner()));
    EXPECT_FALSE(queue_.claim("b"));
}

}  // namespace
}  // namespace vicon::pipeline

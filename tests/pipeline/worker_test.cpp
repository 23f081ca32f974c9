#include "vicon/pipeline/worker.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <thread>

#include <soci/soci.h>
#include "fake_jobs.h"

#include "vicon/core/error.h"
#include "vicon/support/support.h"

namespace vicon::pipeline {
namespace {

const QueueOptions kQuick{.lease_s = 1, .most_attempts = 3, .first_backoff_s = 0.01};
const WorkOptions kUntilIdle{.until_idle = true};

WorkSummary work(FakeStore& fake, const JobWork& job_work, const WorkerEvents& events = {},
                 const WorkOptions& options = kUntilIdle)
{
    const std::atomic<bool> stop = false;
    return runWorker(fake.store, kQuick, options, job_work, events, stop);
}

TEST(Worker, DoesEveryJobAndStopsWhenTheQueueIsEmpty)
{
    FakeStore fake;
    fake.addJobs(3);
    std::vector<std::string> done;
    const auto summary = work(fake, [&](JobContext& context) { done.push_back(context.job().scan_id); });
    EXPECT_THAT(done, testing::ElementsAre("s0", "s1", "s2"));
    EXPECT_EQ(summary.done, 3);
    EXPECT_EQ(summary.failed, 0);
}

TEST(Worker, TriesAgainAndSucceeds)
{
    FakeStore fake;
    fake.addJobs(1);
    int calls = 0;
    const auto summary = work(fake, [&](JobContext&) {
        if (++calls < 3)
            throw Error(ErrorCode::store, "disk busy");
    });
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(summary.done, 1);
}

TEST(Worker, CountsAnUnknownExceptionAsAFailureWithItsReason)
{
    FakeStore fake;
    fake.addJobs(1);
    std::string reason;
    WorkerEvents events;
    events.ended = [&](const Job&, JobState, const std::string& why) { reason = why; };
    const auto summary = work(
        fake, [](JobContext&) { throw std::runtime_error("boom"); }, events);
    EXPECT_EQ(summary.failed, 1);
    EXPECT_EQ(reason, "boom");
}

TEST(Worker, KeepsAReasonThatIsNoTextAsText)
{
    FakeStore fake;
    fake.addJobs(1);
    std::string reason;
    WorkerEvents events;
    events.ended = [&](const Job&, JobState, const std::string& why) { reason = why; };
    work(
        fake, [](JobContext&) { throw std::runtime_error("key '\xff\x1b'"); }, events);
    EXPECT_EQ(reason, "key '\xef\xbf\xbd\\x1b'");
}

TEST(Worker, DoesNotRepeatWhatBadInputMadeFail)
{
    FakeStore fake;
    fake.addJobs(1);
    int calls = 0;
    const auto summary = work(fake, [&](JobContext&) {
        ++calls;
        throw Error(ErrorCode::bad_input, "not a CT");
    });
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(summary.failed, 1);
}

TEST(Worker, DoesAJobAgainThatIsOutdatedWhenItEnds)
{
    FakeStore fake;
    fake.addJobs(1);
    int runs = 0;
    std::vector<JobState> ends;
    WorkerEvents events;
    events.ended = [&](const Job&, JobState state, const std::string&) { ends.push_back(state); };
    const auto summary = work(
        fake, [&](JobContext& context) { context.completeIf([is_current = ++runs == 2] { return is_current; }); },
        events);
    EXPECT_EQ(runs, 2);
    EXPECT_EQ(summary.done, 1);
    EXPECT_THAT(ends, testing::ElementsAre(JobState::queued, JobState::done));
}

TEST(WorkerSqlite, SaysNothingOfAJobThatWentWithItsCaseWhenItEnded)
{
    FakeStore fake;
    fake.addJobs(1);
    // As a deletion does that comes between the job's end and the look at it.
    fake.store.database().session() << "CREATE TRIGGER deleted AFTER UPDATE ON jobs WHEN NEW.state = 'done'"
                                       " BEGIN DELETE FROM jobs WHERE case_id = NEW.case_id; END";
    int told = 0;
    WorkerEvents events;
    events.ended = [&](const Job&, JobState, const std::string&) { ++told; };
    EXPECT_EQ(work(
                  fake, [](JobContext&) {}, events)
                  .done,
              0);
    EXPECT_EQ(told, 0);
}

TEST(Worker, RenewsItsLeaseWhileItWorks)
{
    FakeStore fake;
    fake.addJobs(1);
    const auto summary = work(fake, [&](JobContext&) {
        Database database(fake.store.database().where());
        const auto leaseUntil = [&] { return JobQueue(database, kQuick).find("c", "s0")->lease_until; };
        const double first = leaseUntil();
        ASSERT_TRUE(support::waitUntil([&] { return leaseUntil() > first; }));
        JobQueue when_the_first_lapsed(database, kQuick, [&] { return first; });
        EXPECT_FALSE(when_the_first_lapsed.claim("somebody/else/1/1"));
    });
    EXPECT_EQ(summary.done, 1);
}

TEST(Worker, StopsWhenItsJobWasTakenAndLeavesTheSuccessorAlone)
{
    FakeStore fake;
    fake.addJobs(1);
    const auto summary =
        work(fake,
             [&](JobContext& context) {
                 Database database(fake.store.database().where());
                 JobQueue later(database, kQuick, [&] { return JobQueue(database, kQuick).now() + 100; });
                 ASSERT_TRUE(later.claim("somebody/else/1/1"));
                 EXPECT_THROW(context.commitStep({.step = "segment", .version = 1, .digest = "d"}), Error);
                 EXPECT_TRUE(support::waitUntil([&] { return context.cancelled(); }));
                 context.check();
             },
             {}, {.until_idle = true, .longest_wait_s = 0});
    EXPECT_EQ(summary.done + summary.failed, 0);
    EXPECT_TRUE(fake.store.steps("c", "s0").empty());
}

TEST(Worker, ShowsStepAndProgressInTheTable)
{
    FakeStore fake;
    fake.addJobs(1);
    double fraction = 0;
    WorkerEvents events;
    events.progress = [&](const Job&, double f, const std::string&) { fraction = f; };
    work(
        fake,
        [&](JobContext& context) {
            context.enterStep("segment", 0.2, 0.6);
            context.report(0.5, "labels");
            EXPECT_DOUBLE_EQ(fraction, 0.4);
            EXPECT_EQ(JobQueue(fake.store.database(), kQuick).find("c", "s0")->step, "segment");
        },
        events);
}

TEST(Worker, NeverShowsLessProgressThanBefore)
{
    FakeStore fake;
    fake.addJobs(1);
    std::vector<double> shown;
    WorkerEvents events;
    events.progress = [&](const Job&, double f, const std::string&) { shown.push_back(f); };
    work(
        fake,
        [](JobContext& context) {
            context.enterStep("segment", 0, 0.5);
            context.report(0.9, "a doubt");
            context.report(0.8, "once more");
            context.enterStep("skeleton", 0.4, 1);
            context.report(1, "done");
        },
        events);
    EXPECT_THAT(shown, testing::ElementsAre(0, 0.45, 0.45, 0.45, 1));
}

TEST(Worker, TellsItsWatcherOfReportsOneAtATimeWhereverTheyComeFrom)
{
    FakeStore fake;
    fake.addJobs(1);
    std::atomic<int> inside = 0, calls = 0, overlaps = 0;
    WorkerEvents events;
    events.progress = [&](const Job&, double, const std::string&) {
        overlaps += ++inside > 1;
        ++calls;
        std::this_thread::yield();
        --inside;
    };
    work(
        fake,
        [](JobContext& context) {
            std::vector<std::thread> threads;
            for (int n = 0; n < 4; ++n)
                threads.emplace_back([&] {
                    for (int k = 0; k < 500; ++k)
                        context.report(k / 500.0, "parallel");
                });
            for (auto& thread : threads)
                thread.join();
        },
        events);
    EXPECT_EQ(calls, 2000);
    EXPECT_EQ(overlaps, 0);
}

TEST(Worker, GivesTheJobBackWhenToldToStop)
{
    FakeStore fake;
    fake.addJobs(1);
    std::atomic<bool> stop = false;
    runWorker(
        fake.store, kQuick, kUntilIdle,
        [&](JobContext& context) {
            stop = true;
            context.check();
        },
        {}, stop);
    const auto job = JobQueue(fake.store.database(), kQuick).find("c", "s0");
    EXPECT_EQ(job->state, JobState::queued);
    EXPECT_EQ(job->attempts, 0);
}

TEST(Worker, WaitsForSpaceOnAFullDiskWithoutCountingItAsAFailure)
{
    FakeStore fake;
    fake.addJobs(1);
    for (int n = 0; n < 5; ++n) {
        const auto summary = work(
            fake, [](JobContext&) { throw Error(ErrorCode::store, "cannot be written (No space left on device)"); }, {},
            {.until_idle = true, .longest_wait_s = 0});
        EXPECT_EQ(summary.failed, 0);
        EXPECT_EQ(summary.waiting, 1);
        fake.store.database().session() << "UPDATE jobs SET not_before = 0";
    }
    const auto job = JobQueue(fake.store.database(), kQuick).find("c", "s0");
    EXPECT_EQ(job->state, JobState::queued);
    EXPECT_EQ(job->attempts, 0);
    EXPECT_THAT(job->reason, testing::HasSubstr("waits for space"));
    EXPECT_EQ(work(fake, [](JobContext&) {}).done, 1);
}

TEST(Worker, WaitsForMemoryThatAnotherScanTakesWithoutCountingItAsAFailure)
{
    FakeStore fake;
    fake.addJobs(2);
    std::atomic<int> most_at_once = 0, at_once = 0, done = 0;
    const auto need = [&](JobContext& context) {
        context.reserveMemory(600, 1000);
        most_at_once = std::max<int>(most_at_once, ++at_once);
        EXPECT_TRUE(support::waitUntil([&] {
            return done > 0 || JobQueue(fake.store.database(), kQuick).jobs(JobState::queued).size() == 1;
        })) << "the other one is given back";
        --at_once;
        ++done;
    };
    std::thread beside([&] {
        CaseStore own(fake.store.place());
        const std::atomic<bool> stop = false;
        runWorker(
            own, kQuick, kUntilIdle,
            [&](JobContext& context) {
                context.reserveMemory(600, 1000);
                most_at_once = std::max<int>(most_at_once, ++at_once);
                --at_once;
                ++done;
            },
            {}, stop);
    });
    EXPECT_EQ(work(fake, need).failed, 0);
    beside.join();
    EXPECT_EQ(most_at_once, 1);
    EXPECT_EQ(done, 2);
    for (const Job& job : JobQueue(fake.store.database(), kQuick).jobs(JobState::done))
        EXPECT_EQ(job.attempts, 0);
}

TEST(Worker, GoesOnWhenTheDatabaseCanBeUsedAgain)
{
    FakeStore fake;
    fake.addJobs(1);
    Database other(fake.store.database().where());
    other.session() << "ALTER TABLE jobs RENAME TO lost";
    std::atomic<bool> stop = false;
    int troubles = 0;
    WorkerEvents events;
    events.trouble = [&](const std::string&) {
        ++troubles;
        other.session() << "ALTER TABLE lost RENAME TO jobs";
    };
    events.ended = [&](const Job&, JobState state, const std::string&) {
        EXPECT_EQ(state, JobState::done);
        stop = true;
    };
    runWorker(
        fake.store, kQuick, {}, [](JobContext&) {}, events, stop);
    EXPECT_EQ(troubles, 1);
    EXPECT_TRUE(stop);
}

TEST(Worker, CountsAJobThatEndedFailedBecauseItsWorkersDied)
{
    FakeStore fake;
    fake.addJobs(2);
    fake.store.database().session()
        << "UPDATE jobs SET state = 'running', owner = 'elsewhere/x/1/1', attempts = 9, lease_until = 1"
           " WHERE scan_id = 's0'";
    const auto summary = work(fake, [](JobContext&) {});
    EXPECT_EQ(summary.done, 1);
    EXPECT_EQ(summary.failed, 1);
    EXPECT_EQ(work(fake, [](JobContext&) {}).failed, 0) << "of this run";
}

}  // namespace
}  // namespace vicon::pipeline

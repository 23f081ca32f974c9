// Processes that stand still and go on (SIGSTOP, SIGCONT), as those of a machine that was suspended.
#include <gtest/gtest.h>
#include <signal.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "dicom_writer.h"
#include "running_listener.h"
#include "study.h"
#include "vicon/cases/case_store.h"
#include "vicon/cases/job_queue.h"

namespace fs = std::filesystem;

namespace vicon::support {
namespace {

const int kStops = inFull() ? 20 : 2;
const std::string kLease = " --set queue.lease_s=2";

/// A worker of a store that is told to stand still and to go on.
class StoppableWorker {
public:
    explicit StoppableWorker(const fs::path& store) : process_(::fork())
    {
        const std::string line =
            "exec " + viconBinary() + " work --until-idle" + kLease + " --store " + store.string() + " >/dev/null 2>&1";
        if (process_ == 0) {
            ::execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
            ::_exit(127);
        }
    }
    ~StoppableWorker()
    {
        if (process_ > 0)
            ::kill(process_, SIGKILL);
        goOnUntilItEnds();
    }
    StoppableWorker(const StoppableWorker&) = delete;
    StoppableWorker& operator=(const StoppableWorker&) = delete;

    /// Returns when it stands still, or has ended.
    void stop()
    {
        if (process_ <= 0)
            return;
        int status = 0;
        ::kill(process_, SIGSTOP);
        if (::waitpid(process_, &status, WUNTRACED) == process_ && !WIFSTOPPED(status))
            process_ = -1;
    }
    void goOn() const
    {
        if (process_ > 0)
            ::kill(process_, SIGCONT);
    }
    void goOnUntilItEnds()
    {
        if (process_ <= 0)
            return;
        goOn();
        ::waitpid(process_, nullptr, 0);
        process_ = -1;
    }

private:
    pid_t process_;
};

/// Whether nobody holds the database's lock.
bool takesWrites(const fs::path& store)
{
    sqlite3* database = nullptr;
    const bool takes = sqlite3_open((store / "vicon.db").c_str(), &database) == SQLITE_OK &&
                       sqlite3_exec(database, "BEGIN IMMEDIATE; ROLLBACK", nullptr, nullptr, nullptr) == SQLITE_OK;
    sqlite3_close(database);
    return takes;
}

/// Within a write of a file, too, yet not of the database: SQLite's lock dies with its process alone, so while that
/// stands still everyone else is told to try again later.
bool stopOutsideOfTheDatabase(StoppableWorker& worker, const fs::path& store)
{
    return waitUntil([&] {
        worker.stop();
        if (takesWrites(store))
            return true;
        worker.goOn();
        return false;
    });
}

/// The scan's job as the database has it.
Job jobOf(const fs::path& store)
{
    CaseStore own(store);
    const auto jobs = JobQueue(own.database(), {}).jobs();
    return jobs.empty() ? Job{} : jobs.front();
}

/// Wherever it stands still: its successor does the whole scan, and keeps it.
TEST(StoppedWorker, PastItsLeaseDoesNotOverwriteItsSuccessor)
{
    std::mt19937 random(20261128);
    for (int n = 0; n < kStops; ++n) {
        const TemporaryFolder store;
        viconOn(store.path(), "import " + smallStudy().string());
        StoppableWorker worker(store.path());
        const double from = std::uniform_real_distribution<>(0, 0.9)(random);
        ASSERT_TRUE(waitUntil([&] {
            const Job job = jobOf(store.path());
            return (job.state == JobState::running && job.progress >= from) || job.state == JobState::done;
        }));
        ASSERT_TRUE(stopOutsideOfTheDatabase(worker, store.path()));
        SCOPED_TRACE("stopped at " + std::to_string(jobOf(store.path()).progress));
        viconOn(store.path(), "work --until-idle" + kLease);
        EXPECT_EQ(jobOf(store.path()).state, JobState::done);
        const auto of_successor = filesOf(store.path());
        const long long fence = jobOf(store.path()).fence;
        worker.goOnUntilItEnds();
        EXPECT_EQ(jobOf(store.path()).state, JobState::done);
        EXPECT_EQ(jobOf(store.path()).fence, fence) << "nobody began it anew";
        const auto afterwards = filesOf(store.path());
        ASSERT_EQ(afterwards.size(), of_successor.size());
        for (const auto& [file, content] : of_successor)
            EXPECT_TRUE(afterwards.at(file) == content) << file << " was overwritten";
    }
}

/// Senders wait for it, or come again: nothing is lost, nothing is there twice.
TEST(StoppedListener, GoesOnWithWhatItWasReceiving)
{
    const TemporaryFolder folder;
    const fs::path store = folder / "store";
    const RunningListener listener(store, "--set receive.quiet_s=0.5 --set receive.idle_s=1");
    ASSERT_TRUE(listener.answers());
    std::mt19937 random(20261128);
    std::size_t sent = 0;
    for (int n = 0; n < kStops; ++n) {
        test::SeriesSpec spec;
        spec.study_uid += "." + std::to_string(n);
        spec.series_uid += "." + std::to_string(n);
        spec.patient_id = "P" + std::to_string(n);
        const auto files = test::writeSeries(folder / ("in" + std::to_string(n)), spec);
        sent += files.size();
        std::thread sender([&] {
            NoProgress quiet;
            while (true)
                try {
                    if (ingest::storeFiles(listener.peer(), files, "SCANNER", quiet).complete())
                        return;
                } catch (const Error&) {  // it comes again
                }
        });
        std::this_thread::sleep_for(
            std::chrono::duration<double>(std::uniform_real_distribution<>(0, 0.2)(random)));  // what is tried
        ::kill(listener.process(), SIGSTOP);
        std::this_thread::sleep_for(std::chrono::seconds(2));  // past all of its pauses
        ::kill(listener.process(), SIGCONT);
        sender.join();
    }
    const auto imported = [&] {
        CaseStore own(store);
        std::size_t count = 0;
        for (const CaseRecord& c : own.cases())
            for (const ScanRecord& scan : own.scans(c.id))
                count += own.instances(c.id, scan.id).size();
        return count;
    };
    EXPECT_TRUE(waitUntil([&] { return imported() == sent; })) << imported() << " of " << sent;
    EXPECT_TRUE(listener.answers());
}

}  // namespace
}  // namespace vicon::support
